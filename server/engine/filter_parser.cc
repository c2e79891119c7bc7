#include "server/engine/filter_parser.h"

#include <array>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/request_rules.h"
#include "server/engine/utf8.h"

namespace argmesh {
namespace {

constexpr std::string_view kWordSymbols = "_.-+/@#%";

// Longer ones first.
constexpr std::array<std::pair<std::string_view, FilterOperator>, 7>
    kOperators = {{{"!=", FilterOperator::kNotEqual},
                   {"<=", FilterOperator::kLessOrEqual},
                   {">=", FilterOperator::kGreaterOrEqual},
                   {"=", FilterOperator::kEqual},
                   {"<", FilterOperator::kLess},
                   {">", FilterOperator::kGreater},
                   {":", FilterOperator::kEqual}}};

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool IsWord(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || absl::ascii_isalnum(byte) ||
         kWordSymbols.find(c) != std::string_view::npos;
}

bool IsKeyword(std::string_view word) {
  return word == "AND" || word == "OR" || word == "NOT";
}

bool HasOrder(FilterOperator op) {
  return op != FilterOperator::kEqual && op != FilterOperator::kNotEqual;
}

std::string NamesOf(const std::vector<MetadataKey>& keys) {
  if (keys.empty()) return "none";
  return absl::StrJoin(keys, ", ", [](std::string* out, const MetadataKey& k) {
    *out += k.key;
  });
}

}  // namespace

absl::Status FilterParser::Invalid(size_t position,
                                   const std::string& why) const {
  return MakeError(ErrorReason::kFilterInvalid,
                   absl::StrFormat("filter: at %d: %s", position, why),
                   {{"field", "filter"}, {"position", absl::StrCat(position)}});
}

absl::Status FilterParser::Expected(std::string_view what) const {
  constexpr size_t kShown = 20;
  size_t end = at_;
  while (end < text_.size() && end < at_ + kShown && !IsSpace(text_[end])) {
    ++end;
  }
  // Not within a character.
  while (end < text_.size() && (text_[end] & 0xC0) == 0x80) ++end;
  const std::string found =
      at_ == text_.size()
          ? "the end"
          : absl::StrCat("\"", std::string(text_.substr(at_, end - at_)), "\"");
  return Invalid(
      at_, absl::StrCat("expected ", std::string(what), ", found ", found));
}

void FilterParser::SkipSpaces() {
  while (at_ < text_.size() && IsSpace(text_[at_])) ++at_;
}

bool FilterParser::Take(std::string_view symbol) {
  if (text_.substr(at_, symbol.size()) != symbol) return false;
  at_ += symbol.size();
  SkipSpaces();
  return true;
}

std::string_view FilterParser::PeekWord() const {
  size_t end = at_;
  while (end < text_.size() && IsWord(text_[end])) ++end;
  return text_.substr(at_, end - at_);
}

bool FilterParser::TakeKeyword(std::string_view keyword) {
  return PeekWord() == keyword && Take(keyword);
}

absl::StatusOr<std::optional<FilterNode>> FilterParser::Parse() {
  if (text_.size() > kMaxFilterBytes) {
    return Invalid(kMaxFilterBytes,
                   absl::StrFormat("has %d bytes, more than %d", text_.size(),
                                   kMaxFilterBytes));
  }
  if (!IsUtf8(text_)) return Invalid(0, "is not UTF-8");
  SkipSpaces();
  if (at_ == text_.size()) return std::nullopt;
  ARGMESH_ASSIGN_OR_RETURN(FilterNode root, Conjunction());
  if (at_ != text_.size()) return Expected("AND, OR or the end");
  return root;
}

template <typename Next>
absl::StatusOr<FilterNode> FilterParser::Joined(FilterNode::Kind kind,
                                                std::string_view keyword,
                                                const Next& next) {
  ARGMESH_ASSIGN_OR_RETURN(FilterNode first, next());
  if (PeekWord() != keyword) return first;
  FilterNode joined;
  joined.kind = kind;
  joined.children.push_back(std::move(first));
  while (TakeKeyword(keyword)) {
    ARGMESH_ASSIGN_OR_RETURN(FilterNode child, next());
    joined.children.push_back(std::move(child));
  }
  return joined;
}

absl::StatusOr<FilterNode> FilterParser::Conjunction() {
  return Joined(FilterNode::Kind::kAnd, "AND",
                [this] { return Disjunction(); });
}

absl::StatusOr<FilterNode> FilterParser::Disjunction() {
  return Joined(FilterNode::Kind::kOr, "OR", [this] { return Negation(); });
}

absl::StatusOr<FilterNode> FilterParser::Negation() {
  if (!TakeKeyword("NOT") && !Take("-")) return Primary();
  FilterNode negated;
  negated.kind = FilterNode::Kind::kNot;
  ARGMESH_ASSIGN_OR_RETURN(FilterNode child, Primary());
  negated.children.push_back(std::move(child));
  return negated;
}

absl::StatusOr<FilterNode> FilterParser::Primary() {
  const size_t begin = at_;
  if (!Take("(")) return Term();
  if (++depth_ > kMaxFilterDepth) {
    return Invalid(begin, absl::StrFormat("more than %d parentheses within "
                                          "each other",
                                          kMaxFilterDepth));
  }
  ARGMESH_ASSIGN_OR_RETURN(FilterNode inner, Conjunction());
  if (!Take(")")) return Expected("AND, OR or )");
  --depth_;
  return inner;
}

absl::StatusOr<FilterNode> FilterParser::Term() {
  const size_t begin = at_;
  if (++terms_ > kMaxFilterTerms) {
    return Invalid(begin,
                   absl::StrFormat("more than %d terms", kMaxFilterTerms));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::string name, Text("a metadata key"));
  if (name.size() > kMaxMetadataKeyBytes) {
    return Invalid(begin, absl::StrFormat("a key of %d bytes, more than %d",
                                          name.size(), kMaxMetadataKeyBytes));
  }
  const MetadataKey* const key = FindMetadataKey(keys_, name);
  if (key == nullptr) {
    return MakeError(
        ErrorReason::kFilterKeyUndeclared,
        absl::StrFormat("filter: at %d: \"%s\" is not a metadata key that the "
                        "collection declares; declared: %s",
                        begin, name, NamesOf(keys_)),
        {{"field", "filter"},
         {"position", absl::StrCat(begin)},
         {"key", name}});
  }
  FilterNode node;
  node.term.key = *key;
  ARGMESH_RETURN_IF_ERROR(ReadOperatorAndValue(node.term));
  return node;
}

absl::Status FilterParser::ReadOperatorAndValue(FilterTerm& term) {
  const bool has = text_.substr(at_, 1) == ":";
  ARGMESH_ASSIGN_OR_RETURN(term.op, Operator(term.key));
  if (has && Take("*")) {
    term.op = FilterOperator::kPresent;
    return absl::OkStatus();
  }
  const std::string expected = absl::StrFormat(
      "a value of %s, a %s%s", term.key.key,
      std::string(MetadataTypeName(term.key.type)), has ? ", or *" : "");
  const size_t begin = at_;
  ARGMESH_ASSIGN_OR_RETURN(const std::string text, Text(expected));
  std::optional<MetadataValue> value = ReadMetadataValue(term.key.type, text);
  if (!value) {
    at_ = begin;
    return Expected(expected);
  }
  term.value = *std::move(value);
  return absl::OkStatus();
}

absl::StatusOr<FilterOperator> FilterParser::Operator(const MetadataKey& key) {
  const bool ordered = key.type != MetadataType::kBool;
  for (const auto& [symbol, op] : kOperators) {
    if (text_.substr(at_, symbol.size()) != symbol) continue;
    if (!ordered && HasOrder(op)) break;
    Take(symbol);
    return op;
  }
  return Expected(ordered ? "= != < <= > >= or :" : "= != or :");
}

absl::StatusOr<std::string> FilterParser::Text(std::string_view expected) {
  if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) {
    return Quoted();
  }
  const std::string_view word = PeekWord();
  if (word.empty() || IsKeyword(word)) return Expected(expected);
  Take(word);
  return std::string(word);
}

absl::StatusOr<std::string> FilterParser::Quoted() {
  const size_t begin = at_;
  const char quote = text_[at_];
  std::string value;
  for (++at_; at_ < text_.size(); ++at_) {
    if (text_[at_] == quote) {
      ++at_;
      SkipSpaces();
      return value;
    }
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
    value += text_[at_];
  }
  return Invalid(begin, absl::StrFormat("the string has no closing %c", quote));
}

}  // namespace argmesh
