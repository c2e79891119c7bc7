// Random filters and metadata, with an evaluator of their own: what the server
// parses and looks up in an index is here known from how the text was made.
#ifndef ARGMESH_TESTS_SUPPORT_RANDOM_FILTER_H_
#define ARGMESH_TESTS_SUPPORT_RANDOM_FILTER_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "server/engine/metadata_key.h"

namespace argmesh {

using Metadata = std::map<std::string, std::string>;

// One key of each type, and a second text whose name needs quotes.
std::vector<MetadataKey> SampleMetadataKeys();

// Some of the keys, with values that filters of MakeRandomFilter ask for.
Metadata MakeRandomMetadata(Random& random,
                            const std::vector<MetadataKey>& keys);

struct RandomFilter {
  std::string text;
  std::function<bool(const Metadata&)> holds;
};

// Within the grammar and the limits; `keys` not empty.
RandomFilter MakeRandomFilter(Random& random,
                              const std::vector<MetadataKey>& keys);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_RANDOM_FILTER_H_
