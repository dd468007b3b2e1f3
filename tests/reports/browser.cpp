#include "reports/browser.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Three-dimensional pictures are drawn by the processor.
constexpr const char* kFlags =
    "--headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
    "--enable-logging=stderr --virtual-time-budget=20000";
constexpr int kHeight = 900;  // of the window, pixels

std::string OutputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe.get()))
    output.append(buffer.data(), count);
  return output;
}

std::string ConsoleIn(const std::string& output) {
  std::string console;
  for (std::size_t at = output.find(":CONSOLE"); at != std::string::npos;
       at = output.find(":CONSOLE", at + 1)) {
    console += output.substr(at, output.find('\n', at) - at) + "\n";
  }
  return console;
}

std::string TitleIn(const std::string& output) {
  const std::size_t begin = output.find("<title>{"), end = output.find("</title>", begin);
  if (begin == std::string::npos)
    throw std::runtime_error("no probed title; the console says: " + ConsoleIn(output));
  std::string title = output.substr(begin + 7, end - begin - 7);
  for (const auto& [entity, character] :
       {std::pair{"&amp;", "&"}, std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"}}) {
    for (std::size_t at = title.find(entity); at != std::string::npos; at = title.find(entity, at))
      title.replace(at, std::string(entity).size(), character);
  }
  return title;
}

}  // namespace

bool HasBrowser() {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", kBrowser).c_str()) == 0;
}

SeenPage OpenInBrowser(const fs::path& page, const std::string& probe, int width,
                       const fs::path& screenshot) {
  std::string text = ReadWholeFile(page);
  text.insert(text.rfind("</body>"), "<script>" + probe + "</script>");
  const fs::path probed = page.parent_path() / "probed.html";
  WriteWholeFile(probed, text);
  const std::string picture =
      screenshot.empty() ? "" : fmt::format("--screenshot='{}'", screenshot.string());
  const std::string output = OutputOf(
      fmt::format("timeout 100 {} {} --user-data-dir='{}' --window-size={},{} {} --dump-dom "
                  "'file://{}' 2>&1",
                  kBrowser, kFlags, (page.parent_path() / "profile").string(), width, kHeight,
                  picture, fs::absolute(probed).string()));
  return {nlohmann::json::parse(TitleIn(output)), ConsoleIn(output)};
}

}  // namespace vitruvia
