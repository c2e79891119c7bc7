#include "server/storage/sealed_archive.h"

#include <fcntl.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

// A header block of POSIX.1-1988 (ustar): where its fields begin, how long
// they are.
constexpr size_t kBlock = 512;
struct Field {
  size_t begin;
  size_t size;
};
constexpr Field kName{0, 100};
constexpr Field kMode{100, 8};
constexpr Field kOwner{108, 8};
constexpr Field kGroup{116, 8};
constexpr Field kSize{124, 12};
constexpr Field kTime{136, 12};
constexpr Field kChecksum{148, 8};
constexpr size_t kType = 156;
constexpr Field kMagic{257, 8};
constexpr std::string_view kUstar("ustar\00000", 8);
constexpr char kRegularFile = '0';

constexpr int64_t kMaxOctalSize = (int64_t{1} << 33) - 1;  // 11 digits
constexpr char kBinarySize = '\x80';  // GNU: big-endian number follows
constexpr char kSealName[] = "seal";
constexpr int64_t kSealSize = 65;  // 64 digits and a line break
constexpr int64_t kEndSize = 2 * kBlock;

int64_t PaddingOf(int64_t size) {
  return (static_cast<int64_t>(kBlock) - size % static_cast<int64_t>(kBlock)) %
         static_cast<int64_t>(kBlock);
}

void Set(std::string& block, const Field& field, std::string_view value) {
  std::copy(value.begin(), value.end(),
            block.begin() + static_cast<std::ptrdiff_t>(field.begin));
}

void SetSize(std::string& block, int64_t size) {
  if (size <= kMaxOctalSize) {
    Set(block, kSize, absl::StrFormat("%011o", size));
    return;
  }
  block[kSize.begin] = kBinarySize;
  for (size_t i = 0; i < sizeof(size); ++i) {
    block[kSize.begin + kSize.size - 1 - i] =
        static_cast<char>((size >> (8 * i)) & 0xff);
  }
}

// The checksum counts its own field as blanks.
std::string Header(std::string_view name, int64_t size) {
  std::string block(kBlock, '\0');
  Set(block, kName, name);
  Set(block, kMode, "0000600");
  Set(block, kOwner, "0000000");
  Set(block, kGroup, "0000000");
  SetSize(block, size);
  Set(block, kTime, "00000000000");
  Set(block, kChecksum, "        ");
  block[kType] = kRegularFile;
  Set(block, kMagic, kUstar);
  unsigned sum = 0;
  for (const char c : block) sum += static_cast<unsigned char>(c);
  Set(block, kChecksum, absl::StrFormat("%06o", sum));
  block[kChecksum.begin + 6] = '\0';
  return block;
}

int64_t SizeOf(std::string_view block) {
  const std::string_view field = block.substr(kSize.begin, kSize.size);
  int64_t size = 0;
  if (field[0] == kBinarySize) {
    for (const char c : field.substr(kSize.size - sizeof(size))) {
      size = static_cast<int64_t>((static_cast<uint64_t>(size) << 8) |
                                  static_cast<unsigned char>(c));
    }
    return size;
  }
  for (const char c : field.substr(0, kSize.size - 1)) {
    size = size * 8 + (c - '0');
  }
  return size;
}

}  // namespace

// --- writing -----------------------------------------------------------------

absl::StatusOr<std::unique_ptr<ArchiveWriter>> ArchiveWriter::Create(
    const std::filesystem::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file,
                           OpenFile(path, O_WRONLY | O_CREAT | O_EXCL));
  return std::unique_ptr<ArchiveWriter>(
      new ArchiveWriter(std::move(file), path));
}

absl::Status ArchiveWriter::Put(std::string_view bytes) {
  ARGMESH_RETURN_IF_ERROR(WriteAll(file_, path_, bytes));
  whole_.Update(bytes);
  size_bytes_ += static_cast<int64_t>(bytes.size());
  return absl::OkStatus();
}

absl::Status ArchiveWriter::PadMember() {
  if (member_left_ != 0) {
    return absl::InternalError(
        absl::StrFormat("%d bytes of a member are missing", member_left_));
  }
  const std::string zeros(static_cast<size_t>(PaddingOf(member_size_)), '\0');
  content_.Update(zeros);
  return Put(zeros);
}

absl::Status ArchiveWriter::Begin(std::string_view name, int64_t size) {
  if (name.empty() || name.size() > kMaxMemberName || size < 0) {
    return absl::InternalError("a member's name or size is out of range");
  }
  ARGMESH_RETURN_IF_ERROR(PadMember());
  member_left_ = size;
  member_size_ = size;
  const std::string header = Header(name, size);
  content_.Update(header);
  return Put(header);
}

absl::Status ArchiveWriter::Append(std::string_view bytes) {
  member_left_ -= static_cast<int64_t>(bytes.size());
  if (member_left_ < 0) {
    return absl::InternalError("a member has more bytes than were announced");
  }
  content_.Update(bytes);
  return Put(bytes);
}

absl::StatusOr<ArchiveSummary> ArchiveWriter::Finish() {
  ARGMESH_RETURN_IF_ERROR(PadMember());
  std::string end = Header(kSealName, kSealSize);
  end += ToHex(content_.Finish()) + "\n";
  end.resize(end.size() + static_cast<size_t>(PaddingOf(kSealSize)) +
                 static_cast<size_t>(kEndSize),
             '\0');
  ARGMESH_RETURN_IF_ERROR(Put(end));
  ARGMESH_RETURN_IF_ERROR(SyncFile(file_, path_));
  file_ = PosixFile();
  return ArchiveSummary{size_bytes_, whole_.Finish()};
}

// --- reading -----------------------------------------------------------------

absl::StatusOr<std::unique_ptr<ArchiveReader>> ArchiveReader::Open(
    const std::filesystem::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(PosixFile file, OpenFile(path, O_RDONLY));
  ARGMESH_ASSIGN_OR_RETURN(const int64_t size, FileSize(file, path));
  return std::unique_ptr<ArchiveReader>(
      new ArchiveReader(std::move(file), path, size));
}

absl::Status ArchiveReader::Damaged(std::string_view what) const {
  return MakeError(
      ErrorReason::kStoredDataDamaged,
      absl::StrFormat("snapshot %s: %s near byte %d", path_.string(),
                      std::string(what), position_));
}

absl::StatusOr<std::string> ArchiveReader::Take(int64_t count) {
  if (count > size_ - position_) return Damaged("it ends too early");
  ARGMESH_ASSIGN_OR_RETURN(std::string bytes,
                           ReadAt(file_, path_, position_, count));
  if (static_cast<int64_t>(bytes.size()) != count) {
    return Damaged("it was cut short while it was read");
  }
  position_ += count;
  return bytes;
}

absl::StatusOr<bool> ArchiveReader::Next(ArchiveMember& member) {
  if (member_left_ != 0) {
    return absl::InternalError("the member before was not read to its end");
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::string padding, Take(padding_));
  content_->Update(padding);
  ARGMESH_ASSIGN_OR_RETURN(const std::string block,
                           Take(static_cast<int64_t>(kBlock)));
  const size_t name_size = std::min(block.find('\0'), kName.size - 1);
  member.name = block.substr(0, name_size);
  member.size_bytes = SizeOf(block);
  // The one header the writer makes for this name and size, to the byte.
  if (member.name.empty() || member.size_bytes < 0 ||
      block != Header(member.name, member.size_bytes)) {
    return Damaged("no member's header");
  }
  if (member.name == kSealName) {
    ARGMESH_RETURN_IF_ERROR(CheckSeal(member, content_->Finish()));
    return false;
  }
  if (member.size_bytes > size_ - position_) {
    return Damaged("a member is larger than the file");
  }
  content_->Update(block);
  member_left_ = member.size_bytes;
  padding_ = PaddingOf(member.size_bytes);
  return true;
}

absl::Status ArchiveReader::CheckSeal(const ArchiveMember& seal,
                                      Sha256Digest expected) {
  if (seal.size_bytes != kSealSize) return Damaged("no seal");
  std::string end = ToHex(expected) + "\n";
  end.resize(end.size() + static_cast<size_t>(PaddingOf(kSealSize)) +
                 static_cast<size_t>(kEndSize),
             '\0');
  ARGMESH_ASSIGN_OR_RETURN(const std::string stored,
                           Take(static_cast<int64_t>(end.size())));
  if (stored != end) return Damaged("the seal does not fit");
  if (position_ != size_) return Damaged("bytes after the end");
  return absl::OkStatus();
}

absl::StatusOr<std::string> ArchiveReader::Read(int64_t max_bytes) {
  ARGMESH_ASSIGN_OR_RETURN(std::string bytes,
                           Take(std::min(max_bytes, member_left_)));
  member_left_ -= static_cast<int64_t>(bytes.size());
  content_->Update(bytes);
  return bytes;
}

}  // namespace argmesh
