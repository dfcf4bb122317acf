// SPDX-License-Identifier: MIT
#include <array>
#include <string_view>

#include "report/pages/page.hpp"

namespace lacuna {
namespace {

struct Word {
  std::string_view word, meaning;
};

/// The words of reports that are no everyday words; docs/glossary.md has more.
constexpr std::array kWords = {
    Word{"sigma",
         "How many standard errors a number is away from what chance gives, after allowing for "
         "all that was tried: above 3 it hardly is chance, from 5 on it is none."},
    Word{"probability",
         "Of the candidates compared, how likely each is to be the right one by the records, if "
         "one of them is. It is no statement on candidates that nobody tried."},
    Word{"95 %",
         "An interval that holds the true value in 95 of 100 such experiments; +- is half its "
         "width."},
    Word{"gap",
         "How far a model that runs by itself in windows of a record is off, as a fraction of the "
         "spread of the states."},
    Word{"noise",
         "The standard deviation of what measuring adds to a value. A model that is off by no more "
         "describes all that the record shows."},
    Word{"rms", "Root mean square: the usual size of a number that moves about 0."},
    Word{"residual", "What a model leaves of the data: measured minus modelled."},
    Word{"Synchronisation",
         "The model is driven by the record; a model that is right follows it with a small error."},
    Word{"runs freely",
         "The model is solved from a start without looking at the record again."},
    Word{"FIT", "100 % less the rms error as a fraction of the spread of the channel."},
    Word{"criterion",
         "The number by which composite models are compared: misfit and a penalty for each "
         "parameter; less is better."}};

std::string text_of(const Page& page) {
  std::string text = page.headline;
  for (const std::string& finding : page.findings) text += " " + finding;
  for (const Fact& fact : page.facts) text += " " + fact.label + " " + fact.value + " " + fact.note;
  for (const PageSection& section : page.sections) {
    text += " " + section.title + " " + section.content.string();
    for (const Picture& picture : section.pictures) text += " " + picture.svg.string();
  }
  return text;
}

}  // namespace

std::optional<PageSection> glossary_of(const Page& page) {
  const std::string text = text_of(page);
  Markup entries;
  for (const auto& [word, meaning] : kWords)
    if (text.find(word) != std::string::npos)
      entries += element("dt", Markup::text(std::string(word))) +
                 element("dd", Markup::text(std::string(meaning)));
  if (entries.empty()) return std::nullopt;
  return PageSection{"What the words mean", element("dl", entries), {}, true};
}

}  // namespace lacuna
