// 64-bit content hash (FNV-1a): names caches and sequences. Not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace vitruvia {

class Hash64 {
 public:
  Hash64& Add(const void* data, std::size_t bytes);
  Hash64& Add(std::string_view text) { return Add(text.data(), text.size()); }
  Hash64& AddFile(const std::filesystem::path& file);  // DataError if it cannot be read
  std::uint64_t value() const { return value_; }
  std::string Hex() const;  // 16 digits

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace vitruvia
