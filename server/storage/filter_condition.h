// A MetadataFilter as a condition of SQL on shape s, answered from table
// metadata_value by its primary key. Cost of a page: about 1 us for each value
// that a term holds for, whichever page it is.
#ifndef ARGMESH_SERVER_STORAGE_FILTER_CONDITION_H_
#define ARGMESH_SERVER_STORAGE_FILTER_CONDITION_H_

#include <cstdint>
#include <string>
#include <vector>

#include "server/engine/metadata_filter.h"
#include "server/storage/sqlite_statement.h"

namespace argmesh {

class FilterCondition {
 public:
  // `filter` must outlive it.
  explicit FilterCondition(const MetadataFilter& filter);

  // "1" for a filter that holds for everything. Fixed text and '?'s alone:
  // what the filter's author wrote is only ever bound.
  const std::string& sql() const { return sql_; }

  // The parameters of sql(), in order, for the collection of that number.
  void Bind(int64_t collection, SqliteStatement& statement) const;

 private:
  void Add(const FilterNode& node);
  void AddTerm(const FilterTerm& term);

  std::string sql_;
  std::vector<const FilterTerm*> terms_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_FILTER_CONDITION_H_
