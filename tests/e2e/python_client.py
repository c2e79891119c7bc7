"""Stores a mesh and finds it again, through code that protoc made of proto/.

usage: python_client.py ADDRESS MESH
"""
import pathlib
import sys

import grpc
from argmesh.v1 import collection_service_pb2 as collections
from argmesh.v1 import collection_service_pb2_grpc as collection_service
from argmesh.v1 import search_service_pb2 as searches
from argmesh.v1 import search_service_pb2_grpc as search_service
from argmesh.v1 import shape_service_pb2 as shapes
from argmesh.v1 import shape_service_pb2_grpc as shape_service

channel = grpc.insecure_channel(sys.argv[1])
mesh = {"data": pathlib.Path(sys.argv[2]).read_bytes()}
cups = collection_service.CollectionServiceStub(channel).CreateCollection(
    collections.CreateCollectionRequest(collection_id="cups"), timeout=30)
shape = shape_service.ShapeServiceStub(channel).CreateShape(
    shapes.CreateShapeRequest(parent=cups.name, shape_id="first", mesh=mesh),
    timeout=30)
found = search_service.SearchServiceStub(channel).SearchShapes(
    searches.SearchShapesRequest(parent=cups.name, mesh=mesh), timeout=30)
for match in found.matches:
    print(match.shape.name, f"{match.score:.3f}")
