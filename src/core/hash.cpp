#include "core/hash.h"

#include <array>
#include <fstream>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {

Hash64& Hash64::Add(const void* data, std::size_t bytes) {
  const auto* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) value_ = (value_ ^ byte[i]) * 0x100000001b3ULL;
  return *this;
}

Hash64& Hash64::AddFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {  // a folder opens, but holds no bytes
    throw DataError(fmt::format("{}: cannot be opened for reading", file.string()));
  }
  std::array<char, 65536> buffer;
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
    Add(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return *this;
}

std::string Hash64::Hex() const { return fmt::format("{:016x}", value_); }

}  // namespace vitruvia
