// A real browser, headless, that opens pages in tests. There may be none.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace vitruvia {

inline constexpr const char* kBrowser = "chromium";

bool HasBrowser();

struct SeenPage {
  nlohmann::json probe;  // what the probe wrote into the page's title
  std::string console;   // messages and errors of the page; "" if there are none
};

// A copy of the page with a script of its own added, as a window of that width shows it. The script
// has 20 s of the page's time to make document.title a JSON text. `screenshot`: where a picture of
// the window goes; "": nowhere. std::runtime_error if the title does not come.
SeenPage OpenInBrowser(const std::filesystem::path& page, const std::string& probe, int width,
                       const std::filesystem::path& screenshot = {});

}  // namespace vitruvia
