cmake_minimum_required(VERSION 3.25)

# Holds the layers: every #include of a source file must point to its own
# module or to a module its layer may use. Run as the test architecture.layers:
#
#   cmake -DROOT=<repository> -P cmake/check_layers.cmake
#
# There is no exception list.

set(violations "")

# allow(<folder> <project folders it may include...>)
macro(allow folder)
  set(allowed_${folder} ${ARGN})
  list(APPEND folders ${folder})
endmacro()

allow(core/base core/base)
allow(core/access core/base core/access)
allow(core/mesh core/base core/mesh)
allow(core/geometry core/base core/mesh core/geometry)
allow(core/abstraction core/base core/mesh core/geometry core/abstraction)
allow(core/graph core/base core/mesh core/geometry core/abstraction core/graph)
allow(core/matching core/base core/graph core/matching)
allow(core/signature core/base core/mesh core/geometry core/signature)
allow(core/containment core/base core/mesh core/geometry core/containment)
allow(core/evaluation core/base core/evaluation)
allow(core/synthesis core/base core/mesh core/synthesis)
allow(server/engine core/base core/mesh core/abstraction core/graph
      core/matching core/signature core/containment server/engine)
allow(server/storage core/base server/engine server/storage)
allow(server/telemetry core/base server/engine server/telemetry)
allow(server/rpc proto core/base core/access core/mesh core/abstraction core/graph
      core/matching server/engine server/telemetry server/rpc)
allow(client/picture core/base core/mesh client/picture)
allow(client/cli core/base core/mesh core/evaluation core/access core/synthesis
      proto client client/picture client/cli)
allow(server proto core/base core/access server server/engine server/storage
      server/telemetry server/rpc)
allow(client proto core/base client)

# Third-party headers that only one place may see.
set(only_patterns
    "grpcpp/=server/rpc|server/main.cc|client/|tests/"
    "[.]pb[.]h=server/rpc|client/|tests/"
    "sqlite3[.]h=server/storage|tests/"
    "OpenMesh/=core/mesh/[a-z_]*[.]cc"
    "embree=core/geometry/[a-z_]*[.]cc|client/picture/[a-z_]*[.]cc"
    "Spectra/=core/geometry/[a-z_]*[.]cc"
    "CLI/=client/cli|server/options"
    "prometheus/=server/telemetry"
    "asio=server/engine|server/rpc|server/main.cc")

file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/core/*.h ${ROOT}/core/*.cc
     ${ROOT}/server/*.h ${ROOT}/server/*.cc ${ROOT}/client/*.h
     ${ROOT}/client/*.cc)
list(LENGTH sources source_count)
if(source_count EQUAL 0)
  message(FATAL_ERROR "no sources below ${ROOT}")
endif()

foreach(source IN LISTS sources)
  get_filename_component(folder ${source} DIRECTORY)
  if(NOT DEFINED allowed_${folder})
    list(APPEND violations "${source}: folder ${folder} belongs to no layer")
    continue()
  endif()
  file(STRINGS ${ROOT}/${source} includes REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE ".*[<\"]([^>\"]+)[>\"].*" "\\1" header "${line}")
    if(header MATCHES "^(core|server|client|proto|argmesh|google)/")
      get_filename_component(target ${header} DIRECTORY)
      if(header MATCHES "([.]pb[.]h$|^google/protobuf/)")
        set(target proto)
      endif()
      if(NOT target IN_LIST allowed_${folder})
        list(APPEND violations "${source}: ${folder} may not include ${header}")
      endif()
    endif()
    foreach(entry IN LISTS only_patterns)
      string(REGEX REPLACE "=.*" "" pattern "${entry}")
      string(REGEX REPLACE "^[^=]*=" "" places "${entry}")
      if(header MATCHES "^${pattern}|/${pattern}|${pattern}$"
         AND NOT header MATCHES "^(core|server|client)/"
         AND NOT source MATCHES "^(${places})")
        list(APPEND violations "${source}: ${header} belongs to ${places} only")
      endif()
    endforeach()
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "layers broken:\n  ${text}")
endif()
message(STATUS "layers hold in ${source_count} files")
