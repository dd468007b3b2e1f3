// Messages for people on standard error.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace vitruvia {

// That a message cannot be written (a log on a full disk) must not end the work that it is about.
template <class... Args>
void PrintMessage(fmt::format_string<Args...> text, Args&&... args) {
  std::fputs(fmt::format(text, std::forward<Args>(args)...).c_str(), stderr);
}

}  // namespace vitruvia
