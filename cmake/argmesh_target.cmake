# argmesh_library(NAME SOURCES a.cc b.cc DEPS x y [PRIVATE_DEPS z])
# argmesh_install_libraries(NAMES...)
# argmesh_executable(NAME SOURCES ... DEPS ...)
# argmesh_test(NAME LABEL unit SOURCES ... DEPS ...): below a folder that sets
#   ARGMESH_TEST_GROUP, the group is a second label, and the target GROUP_tests
#   builds its tests.
# argmesh_embed(NAME DATA FILE): links the bytes of FILE into the library
#   NAME, between the symbols argmesh_DATA_begin and argmesh_DATA_end.
#
# One target per module. Headers are found from the repository root
# ("core/mesh/triangle_mesh.h"); warnings and sanitizers are target-scoped.

set(ARGMESH_SANITIZE "" CACHE STRING
    "Sanitizers for our own code: address,undefined or thread")
option(ARGMESH_WERROR "Treat warnings as errors" OFF)

function(argmesh_target_defaults target)
  target_include_directories(
    ${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                     $<INSTALL_INTERFACE:include/argmesh>)
  target_compile_options(
    ${target}
    PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
            -Wold-style-cast -Wnon-virtual-dtor
            $<$<BOOL:${ARGMESH_WERROR}>:-Werror>)
  if(ARGMESH_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${ARGMESH_SANITIZE}
                                             -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${ARGMESH_SANITIZE})
    if(ARGMESH_SANITIZE MATCHES "undefined")
      target_compile_options(${target} PRIVATE -fno-sanitize-recover=undefined)
    endif()
  endif()
endfunction()

function(argmesh_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(argmesh_${name} STATIC ${ARG_SOURCES})
  add_library(argmesh::${name} ALIAS argmesh_${name})
  argmesh_target_defaults(argmesh_${name})
  target_link_libraries(
    argmesh_${name}
    PUBLIC ${ARG_DEPS}
    PRIVATE ${ARG_PRIVATE_DEPS})
endfunction()

# Everything named here goes into the package that find_package(argmesh) finds.
function(argmesh_install_libraries)
  foreach(name IN LISTS ARGN)
    set_target_properties(argmesh_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS argmesh_${name} EXPORT argmeshTargets)
  endforeach()
endfunction()

function(argmesh_embed library name file)
  get_filename_component(path ${file} ABSOLUTE)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_data.S)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded_data.S.in ${source} @ONLY)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${path})
  target_sources(argmesh_${library} PRIVATE ${source})
endfunction()

function(argmesh_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  argmesh_target_defaults(${name})
  target_link_libraries(${name} PRIVATE ${ARG_DEPS})
endfunction()

function(argmesh_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;DEPS" ${ARGN})
  argmesh_executable(${name} SOURCES ${ARG_SOURCES} DEPS ${ARG_DEPS}
                     argmesh::test_support GTest::gmock_main)
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 1800)  # for what hangs; sanitizers take their time
  endif()
  add_test(NAME ${ARG_LABEL}.${name} COMMAND ${name})
  set(labels ${ARG_LABEL} ${ARGMESH_TEST_GROUP})
  set_tests_properties(
    ${ARG_LABEL}.${name}
    PROPERTIES LABELS "${labels}"
               TIMEOUT ${ARG_TIMEOUT}
               SKIP_RETURN_CODE 77)
  if(ARGMESH_TEST_GROUP)
    if(NOT TARGET ${ARGMESH_TEST_GROUP}_tests)
      add_custom_target(${ARGMESH_TEST_GROUP}_tests)
    endif()
    add_dependencies(${ARGMESH_TEST_GROUP}_tests ${name})
  endif()
endfunction()
