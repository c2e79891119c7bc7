"""Lists the services and searches by a mesh, told the API by the server alone.

usage: python_reflection.py ADDRESS COLLECTION MESH
"""
import pathlib
import sys

import grpc
from google.protobuf import (descriptor_database, descriptor_pb2,
                             descriptor_pool, message_factory, text_format)

# What is used here of gRPC's reflection.proto: Debian has no Python package
# of it.
REFLECTION = text_format.Parse(
    """
    name: "reflection.proto"
    message_type { name: "Request"
      field { number: 4 name: "file_containing_symbol" type: TYPE_STRING }
      field { number: 7 name: "list_services" type: TYPE_STRING } }
    message_type { name: "Response"
      field { number: 4 name: "files" type_name: ".Files" }
      field { number: 6 name: "services" type_name: ".Services" } }
    message_type { name: "Files"
      field { number: 1 name: "file" type: TYPE_BYTES label: LABEL_REPEATED } }
    message_type { name: "Services" field { number: 1 name: "service"
      type_name: ".Service" label: LABEL_REPEATED } }
    message_type { name: "Service"
      field { number: 1 name: "name" type: TYPE_STRING } }
    """, descriptor_pb2.FileDescriptorProto())

files = descriptor_database.DescriptorDatabase()
files.Add(REFLECTION)
pool = descriptor_pool.DescriptorPool(files)
channel = grpc.insecure_channel(sys.argv[1])


def message_class(name):
    descriptor = pool.FindMessageTypeByName(name)
    if hasattr(message_factory, "GetMessageClass"):  # protobuf 4.22 and later
        return message_factory.GetMessageClass(descriptor)
    return message_factory.MessageFactory(pool).GetPrototype(descriptor)


def ask_reflection(**question):
    call = channel.stream_stream(
        "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
        message_class("Request").SerializeToString,
        message_class("Response").FromString)
    return next(call(iter([message_class("Request")(**question)]), timeout=30))


def call(service, method, **request):
    rpc = pool.FindServiceByName(service).FindMethodByName(method)
    request_class = message_class(rpc.input_type.full_name)
    return channel.unary_unary(
        f"/{service}/{method}", request_class.SerializeToString,
        message_class(rpc.output_type.full_name).FromString)(
            request_class(**request), timeout=30)


for service in ask_reflection(list_services="*").services.service:
    print("service", service.name)
    described = ask_reflection(file_containing_symbol=service.name).files.file
    for file in map(descriptor_pb2.FileDescriptorProto.FromString, described):
        files.Add(file)
    if described:  # the health service of gRPC itself is only named
        for method in pool.FindServiceByName(service.name).methods:
            print("method", f"{service.name}/{method.name}")
found = call("argmesh.v1.SearchService", "SearchShapes",
             parent=f"collections/{sys.argv[2]}",
             mesh={"data": pathlib.Path(sys.argv[3]).read_bytes()})
for match in found.matches:
    print(match.shape.name, f"{match.score:.3f}")
