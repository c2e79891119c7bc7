#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/base/sha256.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

class ShapeServiceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
  }

  v1::CreateShapeRequest Request(const std::string& id,
                                 const std::string& off) {
    v1::CreateShapeRequest request;
    request.set_parent("collections/c");
    request.set_shape_id(id);
    request.mutable_mesh()->set_data(off);
    return request;
  }

  grpc::Status Create(const v1::CreateShapeRequest& request,
                      v1::Shape* response) {
    grpc::ClientContext context;
    return server_.shapes().CreateShape(&context, request, response);
  }

  grpc::Status Get(const std::string& name, v1::Shape* response) {
    grpc::ClientContext context;
    v1::GetShapeRequest request;
    request.set_name(name);
    return server_.shapes().GetShape(&context, request, response);
  }

  grpc::Status Download(const std::string& name, v1::DownloadMeshHeader* header,
                        std::string* bytes) {
    grpc::ClientContext context;
    v1::DownloadMeshRequest request;
    request.set_name(name);
    const auto reader = server_.shapes().DownloadMesh(&context, request);
    v1::DownloadMeshResponse response;
    while (reader->Read(&response)) {
      if (response.has_header()) *header = response.header();
      bytes->append(response.chunk());
    }
    return reader->Finish();
  }

  grpc::Status GetGraph(const v1::GetShapeGraphRequest& request,
                        v1::GetShapeGraphResponse* response) {
    grpc::ClientContext context;
    return server_.shapes().GetShapeGraph(&context, request, response);
  }

  TestServer server_;
};

TEST_F(ShapeServiceTest, StoresAShapeAndSaysWhatItFound) {
  const std::string off = TorusOff();
  v1::CreateShapeRequest request = Request("ring", off);
  request.mutable_shape()->set_display_name("A ring");
  request.mutable_shape()->set_source_uri("file:ring.off");
  (*request.mutable_shape()->mutable_metadata())["class"] = "torus";
  v1::Shape created;
  ASSERT_CALL_OK(Create(request, &created));
  EXPECT_EQ(created.name(), "collections/c/shapes/ring");
  EXPECT_EQ(created.display_name(), "A ring");
  EXPECT_EQ(created.source_uri(), "file:ring.off");
  EXPECT_EQ(created.metadata().at("class"), "torus");
  EXPECT_EQ(created.state(), v1::SHAPE_STATE_ACTIVE);
  EXPECT_EQ(created.generation(), 1);
  EXPECT_EQ(created.mesh().format(), v1::MESH_FORMAT_OFF);
  EXPECT_EQ(created.mesh().size_bytes(), static_cast<int64_t>(off.size()));
  EXPECT_EQ(created.mesh().sha256(), ToHex(ComputeSha256(off)));
  EXPECT_TRUE(created.mesh().stored());
  EXPECT_EQ(created.mesh().report().vertices(), 24 * 12);
  EXPECT_EQ(created.mesh().report().faces(), 2 * 24 * 12);
  EXPECT_EQ(created.mesh().report().components(), 1);
  EXPECT_EQ(created.mesh().report().euler_characteristic(), 0);
  EXPECT_GT(created.mesh().report().area(), 10.0);
  ASSERT_GT(created.graph().levels_size(), 1);
  for (const auto& level : created.graph().levels()) {
    EXPECT_FALSE(level.name().empty());
    EXPECT_GE(level.nodes(), 1);
  }
  EXPECT_EQ(created.graph().levels(created.graph().levels_size() - 1).name(),
            "uniform");
  v1::Shape stored;
  ASSERT_CALL_OK(Get(created.name(), &stored));
  EXPECT_EQ(stored.etag(), created.etag());
  EXPECT_EQ(stored.graph().SerializeAsString(),
            created.graph().SerializeAsString());
}

TEST_F(ShapeServiceTest, RefusesMeshesItCannotUseWithTheReason) {
  struct Row {
    const char* name;
    std::string bytes;
    grpc::StatusCode code;
    const char* reason;
  };
  const Row rows[] = {
      {"no format", "hello, this is not a mesh at all",
       grpc::StatusCode::INVALID_ARGUMENT, "MESH_FORMAT_UNKNOWN"},
      {"cut short", "OFF\n3 1 0\n0 0 0\n1 0 0\n",
       grpc::StatusCode::INVALID_ARGUMENT, "MESH_MALFORMED"},
      {"index beyond", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       grpc::StatusCode::INVALID_ARGUMENT, "MESH_MALFORMED"},
      {"no faces", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n",
       grpc::StatusCode::INVALID_ARGUMENT, "MESH_EMPTY"},
      {"no area", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n",
       grpc::StatusCode::FAILED_PRECONDITION, "MESH_DEGENERATE"},
      {"no bytes", "", grpc::StatusCode::INVALID_ARGUMENT, "FIELD_REQUIRED"},
  };
  for (const Row& row : rows) {
    v1::Shape response;
    const ErrorOf error(Create(Request("bad", row.bytes), &response));
    EXPECT_EQ(error.code, row.code) << row.name << ": " << error;
    EXPECT_EQ(error.reason, row.reason) << row.name << ": " << error;
  }
  v1::Shape response;
  EXPECT_FAILS(Get("collections/c/shapes/bad", &response), NOT_FOUND,
               "SHAPE_NOT_FOUND");
}

TEST_F(ShapeServiceTest, FollowsThePolicyWhenTheIdIsTaken) {
  v1::Shape first = server_.AddShape("c", "s", TorusOff());
  v1::CreateShapeRequest request = Request("s", TorusOff());
  v1::Shape response;
  EXPECT_FAILS(Create(request, &response), ALREADY_EXISTS, "SHAPE_EXISTS");

  request.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH);
  ASSERT_CALL_OK(Create(request, &response));
  EXPECT_EQ(response.uid(), first.uid());
  EXPECT_EQ(response.generation(), first.generation());

  request.mutable_mesh()->set_data(DumbbellOff());
  EXPECT_FAILS(Create(request, &response), ALREADY_EXISTS, "SHAPE_EXISTS");

  request.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_REPLACE);
  request.set_etag("\"stale\"");
  EXPECT_FAILS(Create(request, &response), ABORTED, "ETAG_MISMATCH");
  request.set_etag(first.etag());
  ASSERT_CALL_OK(Create(request, &response));
  EXPECT_EQ(response.uid(), first.uid());
  EXPECT_EQ(response.mesh().sha256(), ToHex(ComputeSha256(DumbbellOff())));
  EXPECT_GT(response.generation(), first.generation());
}

TEST_F(ShapeServiceTest, AnswersARetriedCreateWithTheFirstShape) {
  v1::CreateShapeRequest request = Request("s", TorusOff());
  request.set_request_id("3f3c3b7a-1111-4222-8333-444455556666");
  v1::Shape first;
  v1::Shape second;
  ASSERT_CALL_OK(Create(request, &first));
  ASSERT_CALL_OK(Create(request, &second));
  EXPECT_EQ(first.uid(), second.uid());
  EXPECT_EQ(first.generation(), second.generation());
  request.mutable_shape()->set_display_name("something else");
  EXPECT_FAILS(Create(request, &second), INVALID_ARGUMENT, "REQUEST_ID_REUSED");
}

TEST_F(ShapeServiceTest, RefusesNamesAndFieldsThatAreNone) {
  v1::Shape response;
  v1::CreateShapeRequest request = Request("ok", TorusOff());
  request.set_parent("collections/none");
  EXPECT_FAILS(Create(request, &response), NOT_FOUND, "COLLECTION_NOT_FOUND");
  request = Request("Not An Id", TorusOff());
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "NAME_INVALID");
  request = Request("ok", TorusOff());
  request.mutable_mesh()->set_format(static_cast<v1::MeshFormat>(99));
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
  request = Request("ok", TorusOff());
  request.mutable_shape()->set_display_name(std::string(257, 'x'));
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_FAILS(Get("collections/c/shapes/none", &response), NOT_FOUND,
               "SHAPE_NOT_FOUND");
  EXPECT_EQ(ErrorOf(Get("collections/c/shapes/none", &response)).resource_name,
            "collections/c/shapes/none");
  EXPECT_FAILS(Get("collections/c", &response), INVALID_ARGUMENT,
               "NAME_INVALID");
}

TEST_F(ShapeServiceTest, ListsEveryShapeOnceWhileOthersAreAdded) {
  std::set<std::string> expected;
  for (int i = 0; i < 11; ++i) {
    const std::string id = "s" + std::to_string(10 + i);
    expected.insert(server_.AddShape("c", id, TorusOff(0.2 + 0.02 * i)).name());
  }
  std::vector<std::string> listed;
  v1::ListShapesRequest request;
  request.set_parent("collections/c");
  request.set_page_size(4);
  int pages = 0;
  do {
    grpc::ClientContext context;
    v1::ListShapesResponse response;
    ASSERT_CALL_OK(server_.shapes().ListShapes(&context, request, &response));
    EXPECT_LE(response.shapes_size(), 4);
    for (const auto& shape : response.shapes()) listed.push_back(shape.name());
    // Before what was listed: must neither repeat nor move a later page.
    if (++pages == 1) server_.AddShape("c", "a-late-one", DumbbellOff());
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty() && pages < 10);
  EXPECT_EQ(pages, 3);
  EXPECT_TRUE(std::is_sorted(listed.begin(), listed.end()));
  EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()), expected);
  EXPECT_EQ(listed.size(), expected.size());
}

TEST_F(ShapeServiceTest, ListsTheShapesThatAFilterHoldsForPageByPage) {
  server_.DeclareKey("c", "class", v1::METADATA_TYPE_STRING);
  for (const char* id : {"a", "b", "d", "e"}) {
    server_.AddShape("c", id, TorusOff(), {{"class", "cup"}});
  }
  server_.AddShape("c", "c", TorusOff(), {{"class", "jug"}});
  v1::ListShapesRequest request;
  request.set_parent("collections/c");
  request.set_filter("class = cup");
  request.set_page_size(3);
  v1::ListShapesResponse response;
  const auto list = [&] {
    grpc::ClientContext context;
    return server_.shapes().ListShapes(&context, request, &response);
  };
  ASSERT_CALL_OK(list());
  ASSERT_EQ(response.shapes_size(), 3);
  EXPECT_EQ(response.shapes(2).name(), "collections/c/shapes/d");
  const std::string token = response.next_page_token();
  request.set_page_token(token);
  ASSERT_CALL_OK(list());
  ASSERT_EQ(response.shapes_size(), 1);
  EXPECT_EQ(response.shapes(0).name(), "collections/c/shapes/e");
  EXPECT_EQ(response.next_page_token(), "");

  for (const char* filter : {"", "class = jug", "class = cup "}) {
    request.set_filter(filter);
    EXPECT_FAILS(list(), INVALID_ARGUMENT, "PAGE_TOKEN_INVALID");
  }
  request.clear_page_token();
  request.set_filter("class = ");
  EXPECT_FAILS(list(), INVALID_ARGUMENT, "FILTER_INVALID");
  request.set_filter("colour = red");
  EXPECT_FAILS(list(), INVALID_ARGUMENT, "FILTER_KEY_UNDECLARED");
}

TEST_F(ShapeServiceTest, KeepsAPageTokenToItsCollection) {
  server_.MakeCollection("d");
  for (const char* id : {"x", "y"}) server_.AddShape("c", id, TorusOff());
  v1::ListShapesRequest request;
  request.set_parent("collections/c");
  request.set_page_size(1);
  grpc::ClientContext first;
  v1::ListShapesResponse response;
  ASSERT_CALL_OK(server_.shapes().ListShapes(&first, request, &response));
  ASSERT_FALSE(response.next_page_token().empty());
  request.set_parent("collections/d");
  request.set_page_token(response.next_page_token());
  grpc::ClientContext second;
  EXPECT_FAILS(server_.shapes().ListShapes(&second, request, &response),
               INVALID_ARGUMENT, "PAGE_TOKEN_INVALID");
}

TEST_F(ShapeServiceTest, DeletesAShapeAndTellsTheGeneration) {
  const v1::Shape shape = server_.AddShape("c", "s", TorusOff());
  v1::DeleteShapeRequest request;
  request.set_name(shape.name());
  request.set_etag("\"stale\"");
  v1::DeleteShapeResponse response;
  grpc::ClientContext stale;
  EXPECT_FAILS(server_.shapes().DeleteShape(&stale, request, &response),
               ABORTED, "ETAG_MISMATCH");
  request.set_etag(shape.etag());
  grpc::ClientContext context;
  ASSERT_CALL_OK(server_.shapes().DeleteShape(&context, request, &response));
  EXPECT_EQ(response.generation(), shape.generation() + 1);
  v1::Shape gone;
  EXPECT_FAILS(Get(shape.name(), &gone), NOT_FOUND, "SHAPE_NOT_FOUND");
  grpc::ClientContext again;
  EXPECT_FAILS(server_.shapes().DeleteShape(&again, request, &response),
               NOT_FOUND, "SHAPE_NOT_FOUND");
}

TEST_F(ShapeServiceTest, GivesTheFileBackByteForByte) {
  const std::string off = SphereOff(60) + std::string(700'000, '\n');
  server_.AddShape("c", "s", off);
  v1::DownloadMeshHeader header;
  std::string bytes;
  ASSERT_CALL_OK(Download("collections/c/shapes/s", &header, &bytes));
  EXPECT_EQ(header.size_bytes(), static_cast<int64_t>(off.size()));
  EXPECT_EQ(header.sha256(), ToHex(ComputeSha256(off)));
  EXPECT_EQ(header.format(), v1::MESH_FORMAT_OFF);
  EXPECT_TRUE(bytes == off);
}

TEST_F(ShapeServiceTest, SaysWhenAFileWasNotKept) {
  server_.MakeCollection("graphs-only", /*store_meshes=*/false);
  const v1::Shape shape = server_.AddShape("graphs-only", "s", TorusOff());
  EXPECT_FALSE(shape.mesh().stored());
  v1::DownloadMeshHeader header;
  std::string bytes;
  EXPECT_FAILS(Download(shape.name(), &header, &bytes), FAILED_PRECONDITION,
               "MESH_NOT_STORED");
  EXPECT_FAILS(Download("collections/c/shapes/none", &header, &bytes),
               NOT_FOUND, "SHAPE_NOT_FOUND");
}

TEST_F(ShapeServiceTest, LabelsEveryFaceAtEveryLevel) {
  const v1::Shape shape = server_.AddShape("c", "s", DumbbellOff());
  v1::GetShapeGraphRequest request;
  request.set_name(shape.name());
  request.set_face_label_view(v1::FACE_LABEL_VIEW_ALL);
  v1::GetShapeGraphResponse response;
  ASSERT_CALL_OK(GetGraph(request, &response));
  const v1::ShapeGraph& graph = response.graph();
  ASSERT_GT(graph.levels_size(), 1);
  ASSERT_TRUE(graph.has_uniform());
  ASSERT_EQ(response.face_labels_size(), graph.levels_size() + 1);
  for (int i = 0; i < response.face_labels_size(); ++i) {
    const v1::FaceLabels& labels = response.face_labels(i);
    const v1::GraphLevel& level =
        i < graph.levels_size() ? graph.levels(i) : graph.uniform();
    EXPECT_EQ(labels.level(), level.name());
    EXPECT_EQ(labels.level_index(), i);
    EXPECT_EQ(labels.total_faces(), shape.mesh().report().faces());
    EXPECT_EQ(labels.labels_size(), labels.total_faces());
    std::set<int> used(labels.labels().begin(), labels.labels().end());
    EXPECT_LT(*used.rbegin(), level.nodes_size()) << labels.level();
    EXPECT_GE(*used.begin(), 0) << labels.level();
  }
  EXPECT_EQ(response.next_first_face(), 0);
  // Nested: a component lies in its parent.
  const int finest = graph.levels_size() - 1;
  for (int f = 0; f < response.face_labels(finest).labels_size(); ++f) {
    const int node = response.face_labels(finest).labels(f);
    EXPECT_EQ(graph.levels(finest).nodes(node).parent(),
              response.face_labels(finest - 1).labels(f));
  }
}

TEST_F(ShapeServiceTest, LabelsOneLevelFromAFaceOn) {
  const v1::Shape shape = server_.AddShape("c", "s", TorusOff());
  v1::GetShapeGraphRequest request;
  request.set_name(shape.name());
  v1::GetShapeGraphResponse response;
  ASSERT_CALL_OK(GetGraph(request, &response));
  EXPECT_EQ(response.face_labels_size(), 0);
  const int levels = response.graph().levels_size();

  request.set_face_label_view(v1::FACE_LABEL_VIEW_LEVEL);
  request.set_face_label_level(levels);  // the uniform cells
  request.set_first_face(500);
  ASSERT_CALL_OK(GetGraph(request, &response));
  EXPECT_FALSE(response.has_graph());
  ASSERT_EQ(response.face_labels_size(), 1);
  EXPECT_EQ(response.face_labels(0).level(), "uniform");
  EXPECT_EQ(response.face_labels(0).first_face(), 500);
  EXPECT_EQ(response.face_labels(0).labels_size(), 2 * 24 * 12 - 500);

  request.set_face_label_level(levels + 1);
  EXPECT_FAILS(GetGraph(request, &response), NOT_FOUND, "NODE_NOT_FOUND");
  request.set_first_face(-1);
  EXPECT_FAILS(GetGraph(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
}

}  // namespace
}  // namespace argmesh
