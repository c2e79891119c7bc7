#include "tests/fuzz/request_mutator.h"

#include <cstdint>
#include <iterator>
#include <limits>
#include <string>

#include "core/base/sha256.h"
#include "server/engine/page_token.h"

namespace argmesh {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr char kTetrahedron[] =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
constexpr double kClearShare = 0.2;
constexpr double kDescendShare = 0.7;

template <typename T, size_t n>
T OneOf(const T (&values)[n], Random& random) {
  return values[static_cast<size_t>(random.Uniform() * static_cast<double>(n))];
}

int64_t Integer(Random& random) {
  constexpr int64_t kIntegers[] = {0,  1,  2,    3,      7,         100,
                                   -1, -2, 1000, 100000, INT32_MAX, INT32_MIN};
  return OneOf(kIntegers, random);
}

double Real(Random& random) {
  constexpr double kReals[] = {0,
                               1,
                               0.5,
                               0.25,
                               -1,
                               1e-9,
                               1e9,
                               1e300,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};
  return OneOf(kReals, random);
}

std::string Text(Random& random) {
  static const std::string kTexts[] = {
      "", "a", "b", "c", "new", "collections/c", "collections/d",
      "collections/c/shapes/a", "collections/c/shapes/b",
      "collections/c/shapes/none", "snapshots/s",
      "operations/0b7c1f9e-6c1e-4b0a-9c55-0d6c3a1f2e4d",
      "0b7c1f9e-6c1e-4b0a-9c55-0d6c3a1f2e4d", "key", "key = 1",
      "key > 0 AND NOT key = 2", "display_name", "metadata", "metadata_keys",
      "source_uri", "*", "../..", kTetrahedron,
      ToHex(ComputeSha256(kTetrahedron)), MakePageToken("collections", "c"),
      MakePageToken("shapes/c", "a"), std::string(300, 'x'),
      std::string(5000, 'y'),
      // A character of two bytes at every place where a text may be cut.
      std::string(199, 'z') + std::string("\xc3\xa9\xc3\xa9"), "\xff\xfe"};
  return kTexts[static_cast<size_t>(random.Uniform() *
                                    static_cast<double>(std::size(kTexts)))];
}

// Sets the field, or adds to it where it is repeated.
void SetScalar(Message& message, const FieldDescriptor& field, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  const auto put = [&](auto set, auto add, auto value) {
    if (field.is_repeated()) {
      (reflection.*add)(&message, &field, value);
    } else {
      (reflection.*set)(&message, &field, value);
    }
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      put(&Reflection::SetInt32, &Reflection::AddInt32,
          static_cast<int32_t>(Integer(random)));
      break;
    case FieldDescriptor::CPPTYPE_INT64:
      put(&Reflection::SetInt64, &Reflection::AddInt64,
          Integer(random) * (random.Uniform() < 0.5 ? 1 : INT32_MAX));
      break;
    case FieldDescriptor::CPPTYPE_UINT32:
      put(&Reflection::SetUInt32, &Reflection::AddUInt32,
          static_cast<uint32_t>(Integer(random)));
      break;
    case FieldDescriptor::CPPTYPE_UINT64:
      put(&Reflection::SetUInt64, &Reflection::AddUInt64,
          static_cast<uint64_t>(Integer(random)));
      break;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      put(&Reflection::SetDouble, &Reflection::AddDouble, Real(random));
      break;
    case FieldDescriptor::CPPTYPE_FLOAT:
      put(&Reflection::SetFloat, &Reflection::AddFloat,
          static_cast<float>(Real(random)));
      break;
    case FieldDescriptor::CPPTYPE_BOOL:
      put(&Reflection::SetBool, &Reflection::AddBool, random.Uniform() < 0.5);
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      put(&Reflection::SetEnumValue, &Reflection::AddEnumValue,
          static_cast<int>(random.Uniform() * 6));
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      if (field.is_repeated()) {
        reflection.AddString(&message, &field, Text(random));
      } else {
        reflection.SetString(&message, &field, Text(random));
      }
      break;
    case FieldDescriptor::CPPTYPE_MESSAGE:
      break;
  }
}

Message* Part(Message& message, const FieldDescriptor& field, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  if (!field.is_repeated()) return reflection.MutableMessage(&message, &field);
  const int size = reflection.FieldSize(message, &field);
  if (size == 0 || random.Uniform() < 0.5) {
    return reflection.AddMessage(&message, &field);
  }
  return reflection.MutableRepeatedMessage(
      &message, &field, static_cast<int>(random.Uniform() * size));
}

}  // namespace

void MutateRequest(Message& request, Random& random) {
  const auto& type = *request.GetDescriptor();
  if (type.field_count() == 0) return;
  const FieldDescriptor& field =
      *type.field(static_cast<int>(random.Uniform() * type.field_count()));
  if (random.Uniform() < kClearShare) {
    request.GetReflection()->ClearField(&request, &field);
  } else if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
    SetScalar(request, field, random);
  } else {
    Message* const part = Part(request, field, random);
    if (random.Uniform() < kDescendShare) MutateRequest(*part, random);
  }
}

}  // namespace argmesh
