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

struct Visit {
  int width = 1280;                    // of the window; below 500 of a frame in it, as a phone's is
  std::string fragment{};              // of the address, after #
  bool dark = false;                   // whether the system asks for dark pages
  std::filesystem::path screenshot{};  // where a picture of the window goes; "": nowhere
};

// A copy of the page with a script of its own added, as the browser shows it. The script has 20 s
// of the page's time to make document.title a JSON text. std::runtime_error if the title does not
// come.
SeenPage OpenInBrowser(const std::filesystem::path& page, const std::string& probe,
                       const Visit& visit = {});

// The page as it is printed.
void PrintInBrowser(const std::filesystem::path& page, const std::filesystem::path& pdf);

}  // namespace vitruvia
