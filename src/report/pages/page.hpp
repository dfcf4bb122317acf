// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/plot/figure.hpp"

namespace lacuna {

/// How good an answer is, as the colour of its headline.
enum class Tone { Good, Doubtful, Bad };

/// A number of the first screen with what it is.
struct Fact {
  std::string label;
  std::string value;
  std::string note;  ///< what it means or is compared with
};

/// A heading with what stands below it: markup, then pictures.
struct PageSection {
  std::string title;
  Markup content;
  std::vector<Picture> pictures = {};
  bool folded = false;  ///< details that are opened by a click
};

/// An answer as a page. It begins with the headline, equations and one picture; findings, facts
/// and sections are below.
struct Page {
  std::string title;     ///< "Diagnosis of pendulum.ode"
  std::string headline;  ///< what was found, in one sentence
  Tone tone = Tone::Good;
  std::vector<std::string> findings;  ///< sentences: what, how sure, how good
  std::vector<Fact> facts;
  Markup equations;
  std::vector<PageSection> sections;
  std::string command = {};               ///< that made it
  std::vector<std::string> first = {};    ///< sentences without which the headline misleads
  std::optional<Picture> picture = {};    ///< the one that shows most
};

/// One self-contained HTML file: styles, pictures and a small script are inside, nothing is
/// loaded from anywhere; light and dark, wide and narrow, printable. The same page gives the
/// same bytes.
std::string format_html(const Page& page);

/// What the words of a page mean, as details that are opened by a click: of those of the glossary
/// that stand in the page. Nothing where none does.
std::optional<PageSection> glossary_of(const Page& page);

/// Takes a picture out of its section and puts it first. Nothing where the page has none of that
/// name.
void show_first(Page& page, const std::string& name);

/// All pictures of a page in their order; names are unique.
std::vector<Picture> pictures_of(const Page& page);

/// A table; numbers are set to the right. @param rows cells as text.
/// @throws ArgumentError when a row has not a cell for each head.
Markup table(const std::vector<std::string>& heads,
             const std::vector<std::vector<std::string>>& rows);

/// A list of sentences, or nothing.
Markup bullets(const std::vector<std::string>& sentences);

}  // namespace lacuna
