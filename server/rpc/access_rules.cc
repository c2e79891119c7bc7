#include "server/rpc/access_rules.h"

#include <algorithm>
#include <iterator>

namespace argmesh {
namespace {

constexpr AccessRole kRead = AccessRole::kRead;
constexpr AccessRole kWrite = AccessRole::kWrite;
constexpr AccessRole kAdmin = AccessRole::kAdmin;
constexpr AccessScope kCollection = AccessScope::kCollection;
constexpr AccessScope kAny = AccessScope::kAny;
constexpr AccessScope kServer = AccessScope::kServer;

constexpr AccessRule kRules[] = {
    {"CollectionService.CreateCollection", kWrite, kCollection, true},
    {"CollectionService.GetCollection", kRead, kCollection, false},
    {"CollectionService.ListCollections", kRead, kAny, false},
    {"CollectionService.UpdateCollection", kWrite, kCollection, true},
    {"CollectionService.DeleteCollection", kAdmin, kCollection, true},
    {"CollectionService.ReindexCollection", kAdmin, kCollection, true},

    {"ShapeService.CreateShape", kWrite, kCollection, true},
    {"ShapeService.UploadShape", kWrite, kCollection, true},
    {"ShapeService.GetShape", kRead, kCollection, false},
    {"ShapeService.ListShapes", kRead, kCollection, false},
    {"ShapeService.UpdateShape", kWrite, kCollection, true},
    {"ShapeService.DeleteShape", kWrite, kCollection, true},
    {"ShapeService.BatchGetShapes", kRead, kCollection, false},
    {"ShapeService.BatchDeleteShapes", kWrite, kCollection, true},
    {"ShapeService.DownloadMesh", kRead, kCollection, false},
    {"ShapeService.GetShapeGraph", kRead, kCollection, false},

    {"IngestService.IngestShapes", kWrite, kCollection, true},
    {"IngestService.ImportShapes", kAdmin, kCollection, true},

    {"SearchService.SearchShapes", kRead, kCollection, false},
    {"SearchService.StreamSearchShapes", kRead, kCollection, false},
    {"SearchService.BatchSearchShapes", kRead, kCollection, false},
    {"SearchService.CompareShapes", kRead, kCollection, false},

    {"AdminService.GetServerInfo", kRead, kAny, false},
    {"AdminService.CreateSnapshot", kAdmin, kServer, true},
    {"AdminService.GetSnapshot", kAdmin, kServer, false},
    {"AdminService.ListSnapshots", kAdmin, kServer, false},
    {"AdminService.DeleteSnapshot", kAdmin, kServer, true},
    {"AdminService.DownloadSnapshot", kAdmin, kServer, false},
    {"AdminService.VerifyStorage", kAdmin, kServer, false},

    {"Operations.ListOperations", kAdmin, kServer, false},
    {"Operations.GetOperation", kAdmin, kAny, false},
    {"Operations.DeleteOperation", kAdmin, kServer, true},
    {"Operations.CancelOperation", kAdmin, kServer, true},
    {"Operations.WaitOperation", kAdmin, kAny, false},
};

}  // namespace

std::span<const AccessRule> AccessRules() { return kRules; }

const AccessRule* FindAccessRule(std::string_view method) {
  const auto* rule =
      std::find_if(std::begin(kRules), std::end(kRules),
                   [&](const AccessRule& r) { return r.method == method; });
  return rule == std::end(kRules) ? nullptr : rule;
}

}  // namespace argmesh
