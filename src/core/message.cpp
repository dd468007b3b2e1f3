#include "core/message.h"

#include <atomic>
#include <cstdio>
#include <string>

namespace vitruvia {
namespace {

std::atomic<bool> bar_on_line{false};

void Write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

void WriteMessage(std::string_view text) {
  Write(fmt::format("{}{}", bar_on_line.exchange(false) ? "\n" : "", text));
}

void DrawBar(std::string_view bar) {
  bar_on_line = true;
  Write(fmt::format("\r{}", bar));
}

}  // namespace vitruvia
