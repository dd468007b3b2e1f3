#include "layering.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "core/files.h"

namespace vitruvia::lint {
namespace {
namespace fs = std::filesystem;

// Headers with a folder or a .h in their name that come with the compiler and the C library. Any
// other such header is third-party and has to be declared by a module.
constexpr std::array kSystemHeaders = {"dlfcn.h",        "fcntl.h",      "fnmatch.h",
                                       "immintrin.h",    "link.h",       "linux/close_range.h",
                                       "malloc.h",       "poll.h",       "pthread.h",
                                       "sched.h",        "signal.h",     "spawn.h",
                                       "stdlib.h",       "sys/mman.h",   "sys/prctl.h",
                                       "sys/resource.h", "sys/socket.h", "sys/stat.h",
                                       "sys/types.h",    "sys/wait.h",   "unistd.h"};

constexpr std::string_view kMethodsFolder = "src/methods";

struct Module {
  std::string name, folder, build_text;
  std::vector<std::string> depends, offers, hides;
};

struct Include {
  int line;
  bool quoted;
  std::string header;
};

std::string FolderOf(const std::string& path) {
  return path.substr(0, std::min(path.rfind('/'), path.size()));
}

std::string WithoutComments(const std::string& cmake) {
  std::string text;
  std::istringstream lines(cmake);
  for (std::string line; std::getline(lines, line);) text += line.substr(0, line.find('#')) + "\n";
  return text;
}

std::vector<Module> ParseModules(const SourceFile& file) {
  std::vector<Module> modules;
  const std::string text = WithoutComments(file.text);
  constexpr std::string_view kCall = "add_module(";
  for (std::size_t at = text.find(kCall); at != std::string::npos; at = text.find(kCall, at + 1)) {
    const std::size_t begin = at + kCall.size();
    std::istringstream words(text.substr(begin, text.find(')', begin) - begin));
    Module module{.name = "",
                  .folder = FolderOf(file.path),
                  .build_text = text,
                  .depends = {},
                  .offers = {},
                  .hides = {}};
    words >> module.name;
    std::vector<std::string> others;
    std::vector<std::string>* list = nullptr;
    for (std::string word; words >> word;) {
      if (word == "DEPENDS")
        list = &module.depends;
      else if (word == "LINKS" || word == "FOLDERS")
        list = &others;
      else if (word == "OFFERS")
        list = &module.offers;
      else if (word == "HIDES")
        list = &module.hides;
      else if (list != nullptr)
        list->push_back(word);
    }
    modules.push_back(std::move(module));
  }
  return modules;
}

std::vector<Include> ParseIncludes(const std::string& text) {
  std::vector<Include> includes;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "#") words >> word;
    if (word != "#include" && word != "include") continue;
    const std::size_t begin = line.find_first_of("<\"");
    if (begin == std::string::npos) continue;
    const bool quoted = line[begin] == '"';
    const std::size_t end = line.find(quoted ? '"' : '>', begin + 1);
    if (end == std::string::npos) continue;
    includes.push_back({number, quoted, line.substr(begin + 1, end - begin - 1)});
  }
  return includes;
}

bool Contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

std::string MatchingPrefix(const std::vector<std::string>& prefixes, const std::string& header) {
  for (const std::string& prefix : prefixes) {
    if (header.starts_with(prefix)) return prefix;
  }
  return "";
}

class Checker {
 public:
  explicit Checker(const std::vector<SourceFile>& tree) {
    for (const SourceFile& file : tree) {
      if (file.path.ends_with("CMakeLists.txt")) {
        for (Module& module : ParseModules(file)) {
          const std::string name = module.name;
          if (!modules_.emplace(name, std::move(module)).second) {
            Report("{}: module {} is declared twice", file.path, name);
          }
        }
      } else {
        includes_[file.path] = ParseIncludes(file.text);
      }
    }
  }

  std::vector<std::string> Check() {
    for (const auto& [name, module] : modules_) CheckDepends(module);
    for (const auto& [name, module] : modules_) CheckForCycle(name, {});
    // The modules that each module's files include; a module without files is not listed.
    std::map<std::string, std::set<std::string>> included;
    for (const auto& [path, includes] : includes_) {
      const Module* own = ModuleOf(path);
      if (own == nullptr) {
        Report("{}: belongs to no module", path);
        continue;
      }
      std::set<std::string>& included_by_own = included[own->name];
      for (const Include& include : includes) {
        CheckInclude(path, *own, include);
        if (const Module* other = ModuleOf(Resolved(include.header))) {
          included_by_own.insert(other->name);
        }
      }
    }
    for (const auto& [name, others] : included) CheckForUnused(modules_.at(name), others);
    return violations_;
  }

 private:
  template <class... Args>
  void Report(fmt::format_string<Args...> message, Args&&... args) {
    violations_.push_back(fmt::format(message, std::forward<Args>(args)...));
  }

  void CheckDepends(const Module& module) {
    for (const std::string& name : module.depends) {
      const auto found = modules_.find(name);
      if (found == modules_.end()) {
        Report("{}: DEPENDS names {}, which is no module", module.name, name);
        continue;
      }
      const std::string& folder = found->second.folder;
      if (FolderOf(folder) == kMethodsFolder && module.folder != kMethodsFolder) {
        Report("{}: DEPENDS names the method {}; only {} may", module.name, name, kMethodsFolder);
      }
    }
  }

  void CheckForUnused(const Module& module, const std::set<std::string>& included) {
    for (const std::string& name : module.depends) {
      if (modules_.contains(name) && !included.contains(name)) {
        Report("{}: DEPENDS names {}, which no file of it includes", module.name, name);
      }
    }
  }

  void CheckForCycle(const std::string& name, std::vector<std::string> above) {
    const auto found = modules_.find(name);
    if (found == modules_.end()) return;
    above.push_back(name);
    for (const std::string& below : found->second.depends) {
      if (below == above.front()) {
        Report("{}: depends on itself: {} → {}", below, fmt::join(above, " → "), below);
      } else if (!Contains(above, below)) {
        CheckForCycle(below, above);
      }
    }
  }

  // The module whose folder holds the file, the innermost if they are nested.
  const Module* ModuleOf(const std::string& path) const {
    const Module* innermost = nullptr;
    for (const auto& [name, module] : modules_) {
      if (!path.starts_with(module.folder + "/")) continue;
      if (innermost == nullptr || module.folder.size() > innermost->folder.size()) {
        innermost = &module;
      }
    }
    return innermost;
  }

  // The file of this tree that an include names, or "".
  std::string Resolved(const std::string& header) const {
    for (const std::string& path : {"src/" + header, header}) {
      if (includes_.contains(path)) return path;
    }
    return "";
  }

  void CheckInclude(const std::string& path, const Module& own, const Include& include) {
    const std::string where = fmt::format("{}:{}", path, include.line);
    const std::string target = Resolved(include.header);
    if (!include.quoted && target.empty()) {
      CheckThirdParty(where, own, include.header);
    } else if (!include.quoted) {
      Report("{}: <{}> is our own header; write it in quotes", where, include.header);
    } else if (target.empty()) {
      // A header that the build writes is named by its module's CMakeLists.txt.
      if (own.build_text.find("/" + include.header) == std::string::npos) {
        Report("{}: \"{}\" is no header of a module, seen from src/ or the top", where,
               include.header);
      }
    } else if (const Module* other = ModuleOf(target); other != nullptr && other != &own) {
      if (!Contains(own.depends, other->name)) {
        Report("{}: \"{}\" is of module {}, which is not in the DEPENDS of {}", where,
               include.header, other->name, own.name);
      }
      std::set<std::string> seen;
      for (const std::string& leaked : HiddenHeadersBehind(target, *other, seen)) {
        Report("{}: \"{}\" brings in <{}>, which {} HIDES", where, include.header, leaked,
               other->name);
      }
    }
  }

  void CheckThirdParty(const std::string& where, const Module& own, const std::string& header) {
    if (!MatchingPrefix(own.offers, header).empty()) return;
    if (!MatchingPrefix(own.hides, header).empty()) return;
    std::set<std::string> below;
    CollectBelow(own, below);
    std::string owners;
    for (const auto& [name, module] : modules_) {
      if (!MatchingPrefix(module.offers, header).empty()) {
        if (below.contains(name)) return;
        owners += fmt::format(" {} OFFERS it but is not below {};", name, own.name);
      }
      if (!MatchingPrefix(module.hides, header).empty()) {
        owners += fmt::format(" {} HIDES it;", name);
      }
    }
    if (!owners.empty()) {
      owners.pop_back();
      Report("{}: <{}>:{}", where, header, owners);
    } else if (IsThirdParty(header)) {
      Report("{}: <{}>: no module declares it", where, header);
    }
  }

  static bool IsThirdParty(const std::string& header) {
    const bool standard_cpp = header.find_first_of("./") == std::string::npos;
    return !standard_cpp &&
           std::find(kSystemHeaders.begin(), kSystemHeaders.end(), header) == kSystemHeaders.end();
  }

  void CollectBelow(const Module& module, std::set<std::string>& below) const {
    for (const std::string& name : module.depends) {
      const auto found = modules_.find(name);
      if (found != modules_.end() && below.insert(name).second) CollectBelow(found->second, below);
    }
  }

  // Third-party headers hidden by `owner` that an includer of its header `path` gets to see.
  std::vector<std::string> HiddenHeadersBehind(const std::string& path, const Module& owner,
                                               std::set<std::string>& seen) const {
    std::vector<std::string> hidden;
    if (!seen.insert(path).second) return hidden;
    for (const Include& include : includes_.at(path)) {
      const std::string target = Resolved(include.header);
      if (target.empty() && !MatchingPrefix(owner.hides, include.header).empty()) {
        hidden.push_back(include.header);
      } else if (!target.empty() && ModuleOf(target) == &owner) {
        for (std::string& further : HiddenHeadersBehind(target, owner, seen)) {
          hidden.push_back(std::move(further));
        }
      }
    }
    return hidden;
  }

  std::map<std::string, Module> modules_;
  std::map<std::string, std::vector<Include>> includes_;  // by the including file's path
  std::vector<std::string> violations_;
};

}  // namespace

std::vector<SourceFile> ReadModuleTree(const fs::path& top) {
  std::vector<SourceFile> tree;
  for (const char* folder : {"src", "synth", "experiments", "reports"}) {
    for (auto entry = fs::recursive_directory_iterator(top / folder);
         entry != fs::recursive_directory_iterator(); ++entry) {
      const fs::path& path = entry->path();
      if (path.filename() == "node_modules") entry.disable_recursion_pending();
      if (!entry->is_regular_file()) continue;
      if (path.extension() != ".h" && path.extension() != ".cpp" &&
          path.filename() != "CMakeLists.txt") {
        continue;
      }
      tree.push_back({path.lexically_relative(top).generic_string(), ReadWholeFile(path)});
    }
  }
  std::sort(tree.begin(), tree.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return tree;
}

std::vector<std::string> LayeringViolations(const std::vector<SourceFile>& tree) {
  return Checker(tree).Check();
}

}  // namespace vitruvia::lint
