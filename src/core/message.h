// Messages for people on standard error.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vitruvia {

// Writes the text in one piece, on a line of its own if a progress bar is being drawn. A message
// that cannot be written (a log on a full disk) is dropped: a lost message must not stop the work.
void WriteMessage(std::string_view text);

template <class... Args>
void PrintMessage(fmt::format_string<Args...> text, Args&&... args) {
  WriteMessage(fmt::format(text, std::forward<Args>(args)...));
}

// A number with its noun: "1 pair", "2 pairs".
template <class Count>
std::string Counted(Count count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == Count{1} ? "" : "s");
}

// Redraws the progress bar on the terminal's current line.
void DrawBar(std::string_view bar);

}  // namespace vitruvia
