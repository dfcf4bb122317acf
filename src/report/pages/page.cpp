// SPDX-License-Identifier: MIT
#include "report/pages/page.hpp"

#include <algorithm>
#include <set>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "lacuna/version.hpp"
#include "page_parts.hpp"

namespace lacuna {
namespace {

std::string tone_class(Tone tone) {
  return tone == Tone::Good ? "good" : tone == Tone::Doubtful ? "doubtful" : "bad";
}

Markup fact_markup(const Fact& fact) {
  Markup inner = element("dt", Markup::text(fact.label)) +
                 element("dd", {{"class", "value"}}, Markup::text(fact.value));
  if (!fact.note.empty()) inner += element("dd", {{"class", "note"}}, Markup::text(fact.note));
  return element("div", {{"class", "fact"}}, inner);
}

/// What may be wider than a screen scrolls by itself, by the keyboard too.
Markup scrolled(const std::string& kind, const Markup& content) {
  return element("div", {{"class", kind}, {"tabindex", "0"}}, content);
}

Markup paragraphs(const std::vector<std::string>& sentences) {
  Markup all;
  for (const std::string& sentence : sentences)
    all += element("p", {{"class", "finding"}}, Markup::text(sentence));
  return all;
}

/// The picture for paper and the one for a phone, of which one is shown.
Markup figure(const Picture& picture) {
  return element("figure", {{"id", picture.name}, {"tabindex", "0"}},
                 picture.svg + picture.narrow);
}

Markup first_screen(const Page& page) {
  Markup all = element("p", {{"class", "kind"}}, Markup::text(page.title)) +
               element("h1", {{"class", tone_class(page.tone)}}, Markup::text(page.headline)) +
               paragraphs(page.first);
  if (!page.equations.empty()) all += scrolled("equations", page.equations);
  if (page.picture) all += figure(*page.picture);
  all += paragraphs(page.findings);
  Markup facts;
  for (const Fact& fact : page.facts) facts += fact_markup(fact);
  if (!facts.empty()) all += element("dl", {{"class", "facts"}}, facts);
  return element("header", all);
}

Markup figures(const PageSection& section) {
  Markup all;
  for (const Picture& picture : section.pictures) all += figure(picture);
  return all;
}

Markup section_markup(const PageSection& section) {
  const Markup body = section.content + figures(section);
  if (!section.folded)
    return element("section", element("h2", Markup::text(section.title)) + body);
  return element("details", element("summary", Markup::text(section.title)) + body);
}

/// Columns in which every cell is a number, perhaps with an error or a unit, or a dash.
std::vector<bool> number_columns(std::size_t count,
                                 const std::vector<std::vector<std::string>>& rows) {
  std::vector<bool> numbers(count, !rows.empty());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < count; ++c)
      if (!row[c].empty() && row[c] != "-" &&
          !parse_number(row[c].substr(0, row[c].find_first_of(" %"))))
        numbers[c] = false;
  return numbers;
}

}  // namespace

std::string format_html(const Page& page) {
  Markup head = empty_element("meta", {{"charset", "utf-8"}}) +
                empty_element("meta", {{"name", "viewport"},
                                       {"content", "width=device-width, initial-scale=1"}}) +
                // Nothing may be loaded, whatever stands in the page.
                empty_element("meta", {{"http-equiv", "Content-Security-Policy"},
                                       {"content",
                                        "default-src 'none'; style-src 'unsafe-inline'; "
                                        "script-src 'unsafe-inline'; img-src data:"}}) +
                element("title", Markup::text(page.title)) +
                element("style", Markup::own(picture_style() + page_style()));
  Markup body = first_screen(page);
  for (const PageSection& section : page.sections) body += section_markup(section);
  if (const auto glossary = glossary_of(page)) body += section_markup(*glossary);
  Markup foot = Markup::text("Made by lacuna " + std::string(kVersion));
  if (!page.command.empty())
    foot += Markup::text(" with ") + element("code", Markup::text(page.command));
  body = element("main", body) + element("footer", foot);
  body += element("script", Markup::own(page_script()));
  return "<!DOCTYPE html>\n" +
         element("html", {{"lang", "en"}}, element("head", head) + element("body", body))
             .string() +
         "\n";
}

std::vector<Picture> pictures_of(const Page& page) {
  std::vector<Picture> all;
  if (page.picture) all.push_back(*page.picture);
  for (const PageSection& section : page.sections)
    all.insert(all.end(), section.pictures.begin(), section.pictures.end());
  std::set<std::string> names;
  for (Picture& picture : all) {
    const std::string name = picture.name;
    for (int number = 2; !names.insert(picture.name).second; ++number)
      picture.name = name + "_" + std::to_string(number);
  }
  return all;
}

void show_first(Page& page, const std::string& name) {
  for (auto section = page.sections.begin(); section != page.sections.end(); ++section) {
    std::vector<Picture>& pictures = section->pictures;
    const auto found = std::find_if(pictures.begin(), pictures.end(),
                                    [&](const Picture& one) { return one.name == name; });
    if (found == pictures.end()) continue;
    page.picture = std::move(*found);
    pictures.erase(found);
    if (pictures.empty()) page.sections.erase(section);
    return;
  }
}

Markup table(const std::vector<std::string>& heads,
             const std::vector<std::vector<std::string>>& rows) {
  for (const auto& row : rows)
    check_argument(row.size() == heads.size(), "table", "a row has not a cell for each head");
  const std::vector<bool> numbers = number_columns(heads.size(), rows);
  const auto cells = [&](std::string_view name, const std::vector<std::string>& texts) {
    Markup all;
    for (std::size_t c = 0; c < texts.size(); ++c)
      all += numbers[c] ? element(name, {{"class", "number"}}, Markup::text(texts[c]))
                        : element(name, Markup::text(texts[c]));
    return element("tr", all);
  };
  Markup body;
  for (const auto& row : rows) body += cells("td", row);
  return scrolled("wide",
                  element("table", element("thead", cells("th", heads)) + element("tbody", body)));
}

Markup bullets(const std::vector<std::string>& sentences) {
  Markup all;
  for (const std::string& sentence : sentences) all += element("li", Markup::text(sentence));
  return all.empty() ? all : element("ul", all);
}

}  // namespace lacuna
