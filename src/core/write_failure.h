// The error of a file that cannot be written.
#pragma once

#include <filesystem>

namespace vitruvia {

// RunError naming the file and the reason: an errno, or 0 if none is known.
[[noreturn]] void FailToWrite(const std::filesystem::path& file, int error);

}  // namespace vitruvia
