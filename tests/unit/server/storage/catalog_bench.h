// The catalogs that the port's test suite runs against.
#ifndef ARGMESH_TESTS_UNIT_SERVER_STORAGE_CATALOG_BENCH_H_
#define ARGMESH_TESTS_UNIT_SERVER_STORAGE_CATALOG_BENCH_H_

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "server/engine/catalog.h"
#include "server/engine/error_reason.h"
#include "server/storage/data_directory.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {

enum class CatalogKind { kMemory, kSqlite };

inline std::string CatalogKindName(
    const ::testing::TestParamInfo<CatalogKind>& info) {
  return info.param == CatalogKind::kMemory ? "Memory" : "Sqlite";
}

template <typename T>
ErrorReason ReasonOrOk(const absl::StatusOr<T>& result) {
  return ReasonOf(result.status()).value_or(ErrorReason{0});
}
inline ErrorReason ReasonOrOk(const absl::Status& status) {
  return ReasonOf(status).value_or(ErrorReason{0});
}

class CatalogPortTest : public ::testing::TestWithParam<CatalogKind> {
 protected:
  void SetUp() override {
    if (GetParam() == CatalogKind::kMemory) {
      catalog_ = std::make_unique<MemoryCatalog>();
      return;
    }
    absl::StatusOr<std::shared_ptr<DataDirectory>> directory =
        DataDirectory::Open(
            folder_.path() / "data",
            {.min_free_bytes = 0, .allow_network_file_system = true});
    ASSERT_TRUE(directory.ok()) << directory.status();
    absl::StatusOr<std::unique_ptr<SqliteCatalog>> catalog =
        SqliteCatalog::Open(*std::move(directory));
    ASSERT_TRUE(catalog.ok()) << catalog.status();
    catalog_ = *std::move(catalog);
  }

  TemporaryDirectory folder_;
  std::unique_ptr<Catalog> catalog_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_SERVER_STORAGE_CATALOG_BENCH_H_
