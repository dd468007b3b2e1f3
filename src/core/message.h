// Messages for people on standard error.
#pragma once

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

// Redraws the progress bar on the terminal's current line.
void DrawBar(std::string_view bar);

}  // namespace vitruvia
