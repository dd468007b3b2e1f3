#include "type_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <string_view>

#include <fmt/format.h>

namespace vitruvia::lint {
namespace {

// The end of what begins at `at` and is no code: a comment, a literal, a preprocessor line. `at`
// itself where code stands.
std::size_t EndOfNoCode(const std::string& text, std::size_t at) {
  const auto after = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  const std::string_view rest = std::string_view(text).substr(at);
  if (rest.starts_with("//")) return after("\n", at) - 1;
  if (rest.starts_with("/*")) return after("*/", at + 2);
  if (rest.starts_with("R\"")) {
    const std::size_t open = text.find('(', at);
    return after(")" + text.substr(at + 2, open - at - 2) + "\"", open);
  }
  const bool starts_line = at == 0 || text[at - 1] == '\n';
  if (starts_line && rest.starts_with("#")) {
    std::size_t end = after("\n", at);
    while (end < text.size() && text[end - 2] == '\\') end = after("\n", end);
    return end - 1;
  }
  const char quote = rest.front();
  const bool in_number = quote == '\'' && at > 0 && std::isxdigit(text[at - 1]) != 0;
  if ((quote != '"' && quote != '\'') || in_number) return at;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != quote) end += text[end] == '\\' ? 2 : 1;
  return end + 1;
}

std::string BareCode(const std::string& text) {
  std::string code;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = EndOfNoCode(text, at);
    code += end == at ? text[at] : ' ';
    at = std::max(end, at + 1);
  }
  return code;
}

// A scope that a brace opens: a named namespace, or anything else, which hides what is inside.
struct Scope {
  bool is_namespace;
  std::string name;
};

// What a brace opens, from the words before it: those since the last ; { or }.
Scope ScopeOf(const std::string& head) {
  static const std::regex kNamespace(R"(\s*(?:inline\s+)?namespace\s+([\w:]+)\s*)");
  std::smatch match;
  if (std::regex_match(head, match, kNamespace)) return {true, match[1]};
  return {false, ""};
}

// The name of the type that a brace after `head` defines, or "".
std::string TypeDefinedBy(const std::string& head) {
  static const std::regex kType(
      R"(\s*(?:template\s*<[\s\S]*>\s*)?(?:class|struct|union|enum(?:\s+class)?)\s+)"
      R"((?:alignas\([^)]*\)\s*)?(\w+)\s*(?:final\s*)?(?::(?!:)[\s\S]*)?)");
  std::smatch match;
  return std::regex_match(head, match, kType) ? match[1].str() : "";
}

std::vector<std::string> TypesDefinedIn(const std::string& text) {
  std::vector<std::string> types;
  std::vector<Scope> scopes;
  std::string head;
  for (const char c : BareCode(text)) {
    if (c == '{') {
      bool at_namespace = true;
      std::string qualified;
      for (const Scope& scope : scopes) {
        at_namespace = at_namespace && scope.is_namespace;
        qualified += scope.name + "::";
      }
      if (const std::string type = TypeDefinedBy(head); at_namespace && !type.empty()) {
        types.push_back(qualified + type);
      }
      scopes.push_back(ScopeOf(head));
    } else if (c == '}' && !scopes.empty()) {
      scopes.pop_back();
    }
    if (c == '{' || c == '}' || c == ';') {
      head.clear();
    } else {
      head += c;
    }
  }
  return types;
}

}  // namespace

std::vector<std::string> TypesDefinedTwice(const std::vector<SourceFile>& tree) {
  std::map<std::string, std::string> first_file;
  std::vector<std::string> violations;
  for (const SourceFile& file : tree) {
    if (file.path.ends_with("CMakeLists.txt")) continue;
    for (const std::string& type : TypesDefinedIn(file.text)) {
      const auto [found, is_new] = first_file.emplace(type, file.path);
      if (is_new) continue;
      violations.push_back(
          fmt::format("{}: {} is defined in {} too", file.path, type, found->second));
    }
  }
  return violations;
}

}  // namespace vitruvia::lint
