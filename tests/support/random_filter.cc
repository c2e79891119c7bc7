#include "tests/support/random_filter.h"

#include <cstdlib>
#include <cstring>
#include <utility>

namespace argmesh {
namespace {

using Holds = std::function<bool(const Metadata&)>;

std::string RandomValue(Random& random, MetadataType type) {
  static const std::vector<std::string> kTexts = {
      "",     "red",    "Red",  "red ", "größe", "a b",
      "it's", "\"hi\"", "a\\b", "AND",  "%",     "'; DROP TABLE shape; --",
      "*",    "12"};
  static const std::vector<std::string> kNumbers = {
      "0", "-0", "1", "1.0", "-5", "2.5", "1e3", "1000", "0.1", "1e-300"};
  switch (type) {
    case MetadataType::kString:
      return kTexts[random.Below(kTexts.size())];
    case MetadataType::kNumber:
      return kNumbers[random.Below(kNumbers.size())];
    case MetadataType::kBool:
      break;
  }
  return random.Below(2) == 0 ? "true" : "false";
}

// -1, 0 or 1; a bool is 0 or 1 by its name.
int Compare(MetadataType type, const std::string& a, const std::string& b) {
  if (type == MetadataType::kNumber) {
    const double x = std::strtod(a.c_str(), nullptr);
    const double y = std::strtod(b.c_str(), nullptr);
    return x < y ? -1 : (x > y ? 1 : 0);
  }
  const size_t common = std::min(a.size(), b.size());
  const int bytes = std::memcmp(a.data(), b.data(), common);
  if (bytes != 0) return bytes < 0 ? -1 : 1;
  return a.size() < b.size() ? -1 : (a.size() > b.size() ? 1 : 0);
}

class Maker {
 public:
  Maker(Random& random, const std::vector<MetadataKey>& keys)
      : random_(random), keys_(keys) {}

  RandomFilter Conjunction(int depth) {
    return Join(" AND ", 1 + random_.Below(3), /*all=*/true,
                [this, depth] { return Disjunction(depth); });
  }

 private:
  RandomFilter Disjunction(int depth) {
    return Join(" OR ", 1 + random_.Below(2), /*all=*/false,
                [this, depth] { return Negation(depth); });
  }

  RandomFilter Negation(int depth) {
    RandomFilter inner = Primary(depth);
    if (random_.Below(4) != 0) return inner;
    return {(random_.Below(2) == 0 ? "NOT " : "-") + inner.text,
            [holds = inner.holds](const Metadata& m) { return !holds(m); }};
  }

  RandomFilter Primary(int depth) {
    if (depth == 0 || random_.Below(3) != 0) return Term();
    RandomFilter inner = Conjunction(depth - 1);
    inner.text = "(" + Space() + inner.text + Space() + ")";
    return inner;
  }

  RandomFilter Term() {
    const MetadataKey& key = keys_[random_.Below(keys_.size())];
    if (random_.Below(8) == 0) {
      return {Word(key.key) + ":" + Space() + "*",
              [name = key.key](const Metadata& m) { return m.contains(name); }};
    }
    struct Operator {
      const char* symbol;
      bool less, equal, greater;
    };
    static constexpr Operator kOperators[] = {
        {"=", false, true, false}, {":", false, true, false},
        {"!=", true, false, true}, {"<", true, false, false},
        {"<=", true, true, false}, {">", false, false, true},
        {">=", false, true, true}};
    const Operator op =
        kOperators[random_.Below(key.type == MetadataType::kBool ? 3 : 7)];
    const std::string value = RandomValue(random_, key.type);
    return {Word(key.key) + Space() + op.symbol + Space() + Word(value),
            [key, op, value](const Metadata& m) {
              const auto entry = m.find(key.key);
              if (entry == m.end()) return false;
              const int order = Compare(key.type, entry->second, value);
              return order < 0 ? op.less : (order > 0 ? op.greater : op.equal);
            }};
  }

  template <typename Next>
  RandomFilter Join(const char* joint, uint64_t count, bool all,
                    const Next& next) {
    RandomFilter joined = next();
    for (uint64_t i = 1; i < count; ++i) {
      RandomFilter other = next();
      joined.text += joint + Space() + other.text;
      joined.holds = [all, a = std::move(joined.holds),
                      b = std::move(other.holds)](const Metadata& m) {
        return all ? a(m) && b(m) : a(m) || b(m);
      };
    }
    return joined;
  }

  std::string Space() { return std::string(random_.Below(3), ' '); }

  // Bare where that is allowed, but not always.
  std::string Word(const std::string& text) {
    const bool bare =
        !text.empty() && text != "AND" &&
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyzRö0123456789.-ß") ==
            std::string::npos;
    if (bare && random_.Below(3) != 0) return text;
    const char quote = random_.Below(2) == 0 ? '"' : '\'';
    std::string quoted(1, quote);
    for (const char c : text) {
      if (c == quote || c == '\\') quoted += '\\';
      quoted += c;
    }
    return quoted + quote;
  }

  Random& random_;
  const std::vector<MetadataKey>& keys_;
};

}  // namespace

std::vector<MetadataKey> SampleMetadataKeys() {
  return {{"colour", MetadataType::kString},
          {"a \"key\"", MetadataType::kString},
          {"mass", MetadataType::kNumber},
          {"round", MetadataType::kBool}};
}

Metadata MakeRandomMetadata(Random& random,
                            const std::vector<MetadataKey>& keys) {
  Metadata metadata;
  for (const MetadataKey& key : keys) {
    if (random.Below(4) == 0) continue;
    metadata[key.key] = RandomValue(random, key.type);
  }
  return metadata;
}

RandomFilter MakeRandomFilter(Random& random,
                              const std::vector<MetadataKey>& keys) {
  return Maker(random, keys).Conjunction(1);
}

}  // namespace argmesh
