// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna::support {

/// What is wrong first with markup as XML has it: tags that do not close one another,
/// attributes without quotes, a bare & or <. Empty where nothing is. What stands in <script>
/// and <style> is not looked at.
inline std::string first_fault(const std::string& text) {
  std::vector<std::string> open;
  std::size_t at = text.rfind("<!DOCTYPE html>", 0) == 0 ? 15 : 0;
  while (at < text.size()) {
    if (text[at] == '&' && text.find(';', at) > at + 8)
      return "bare & at " + std::to_string(at);
    if (text[at] != '<') {
      ++at;
      continue;
    }
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "open tag at the end";
    std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "< inside of a tag: " + tag;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1))
        return "</" + tag.substr(1) + "> closes nothing";
      open.pop_back();
    } else {
      int quotes = 0;
      for (const char c : tag) quotes += c == '"';
      if (quotes % 2 != 0) return "quotes of " + tag;
      const std::string name = tag.substr(0, tag.find_first_of(" /"));
      if (tag.back() != '/') open.push_back(name);
      if (name == "script" || name == "style") {
        at = text.find("</" + name, end);
        continue;
      }
    }
    at = end + 1;
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace lacuna::support
