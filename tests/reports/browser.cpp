#include "reports/browser.h"

#include <algorithm>
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
constexpr int kHeight = 900;           // of the window, pixels
constexpr int kNarrowestWindow = 500;  // that this browser opens

// A narrower page stands in a frame and tells its title to the window.
constexpr const char* kPhone = R"html(<!doctype html><title>phone</title>
<iframe src="probed.html" style="width:{}px;height:812px;border:0"></iframe>
<script>addEventListener("message", event => document.title = event.data);</script>
)html";
constexpr const char* kTellTheWindow = R"html(<script>
const tell = setInterval(() => {
  if (!document.title.startsWith("{")) return;
  clearInterval(tell);
  parent.postMessage(document.title, "*");
}, 20);
</script>)html";

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

SeenPage OpenInBrowser(const fs::path& page, const std::string& probe, const Visit& visit) {
  const fs::path probed = page.parent_path() / "probed.html";
  std::string text = ReadWholeFile(page);
  text.insert(text.rfind("</body>"), "<script>" + probe + "</script>");
  fs::path shown = probed;
  if (visit.width < kNarrowestWindow) {
    text.insert(text.rfind("</body>"), kTellTheWindow);
    shown = page.parent_path() / "phone.html";
    WriteWholeFile(shown, fmt::format(kPhone, visit.width));
  }
  WriteWholeFile(probed, text);
  const std::string picture =
      visit.screenshot.empty() ? "" : fmt::format("--screenshot='{}'", visit.screenshot.string());
  const std::string output = OutputOf(fmt::format(
      "timeout 100 {} {} {} --user-data-dir='{}' --window-size={},{} {} --dump-dom "
      "'file://{}{}{}' 2>&1",
      kBrowser, kFlags, visit.dark ? "--blink-settings=preferredColorScheme=0" : "",
      (page.parent_path() / "profile").string(), std::max(visit.width, kNarrowestWindow), kHeight,
      picture, fs::absolute(shown).string(), visit.fragment.empty() ? "" : "#", visit.fragment));
  return {nlohmann::json::parse(TitleIn(output)), ConsoleIn(output)};
}

void PrintInBrowser(const fs::path& page, const fs::path& pdf) {
  OutputOf(fmt::format(
      "timeout 100 {} {} --user-data-dir='{}' --no-pdf-header-footer --print-to-pdf='{}' "
      "'file://{}' 2>&1",
      kBrowser, kFlags, (page.parent_path() / "profile").string(), pdf.string(),
      fs::absolute(page).string()));
}

}  // namespace vitruvia
