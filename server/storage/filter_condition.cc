#include "server/storage/filter_condition.h"

#include "server/storage/metadata_values.h"

namespace argmesh {
namespace {

const char* ComparisonOf(FilterOperator op) {
  switch (op) {
    case FilterOperator::kEqual:
      return " AND value = ?";
    case FilterOperator::kNotEqual:
      return " AND value <> ?";
    case FilterOperator::kLess:
      return " AND value < ?";
    case FilterOperator::kLessOrEqual:
      return " AND value <= ?";
    case FilterOperator::kGreater:
      return " AND value > ?";
    case FilterOperator::kGreaterOrEqual:
      return " AND value >= ?";
    case FilterOperator::kPresent:
      break;
  }
  return "";
}

}  // namespace

FilterCondition::FilterCondition(const MetadataFilter& filter) {
  if (filter.root()) {
    Add(*filter.root());
  } else {
    sql_ = "1";
  }
}

void FilterCondition::Add(const FilterNode& node) {
  if (node.kind == FilterNode::Kind::kTerm) {
    AddTerm(node.term);
    return;
  }
  const char* const joint =
      node.kind == FilterNode::Kind::kAnd ? " AND " : " OR ";
  sql_ += node.kind == FilterNode::Kind::kNot ? "NOT (" : "(";
  for (size_t i = 0; i < node.children.size(); ++i) {
    if (i > 0) sql_ += joint;
    Add(node.children[i]);
  }
  sql_ += ")";
}

// The set of shapes is made once for each statement, not once for each shape.
void FilterCondition::AddTerm(const FilterTerm& term) {
  sql_ +=
      "s.id IN (SELECT shape_id FROM metadata_value "
      "WHERE collection_id = ? AND key = ?";
  sql_ += ComparisonOf(term.op);
  sql_ += ")";
  terms_.push_back(&term);
}

void FilterCondition::Bind(int64_t collection,
                           SqliteStatement& statement) const {
  for (const FilterTerm* term : terms_) {
    statement.Bind(collection);
    statement.Bind(term->key.key);
    if (term->op != FilterOperator::kPresent) {
      BindMetadataValue(term->value, statement);
    }
  }
}

}  // namespace argmesh
