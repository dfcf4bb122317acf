// SPDX-License-Identifier: MIT
#include "bases/monomials.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>

#include "bases/term_list.hpp"

namespace lacuna {
namespace {

// A fact of memory: an elimination of more terms has no room.
constexpr int kMostTerms = 100000;

using Exponents = std::vector<int>;

/// Lists exponents of `count` variables depth first, spending degrees of either sign.
class ExponentLister {
 public:
  ExponentLister(std::size_t count, int min_degree, int max_degree)
      : current_(count, 0), min_degree_(min_degree), max_degree_(max_degree) {}

  std::vector<Exponents> list() {
    visit(0, max_degree_, std::min(min_degree_, 0));
    return std::move(found_);
  }

 private:
  void visit(std::size_t position, int above, int below) {
    if (position == current_.size()) return keep();
    for (int e = above; e >= below; --e) {
      current_[position] = e;
      visit(position + 1, above - std::max(e, 0), below - std::min(e, 0));
    }
    current_[position] = 0;
  }

  void keep() {
    const int degree = std::accumulate(current_.begin(), current_.end(), 0);
    if (min_degree_ <= 0 || degree >= min_degree_) found_.push_back(current_);
  }

  Exponents current_;
  int min_degree_;
  int max_degree_;
  std::vector<Exponents> found_;
};

/// Numbers of monomials in one variable more.
/// @param counts by the sum of the positive exponents (rows, from 0) and of the negative ones
/// (columns, from 0 down).
Matrix with_one_more(const Matrix& counts) {
  Matrix more = counts;
  for (Index e = 1; e < counts.rows(); ++e)
    more.bottomRows(counts.rows() - e) += counts.topRows(counts.rows() - e);
  for (Index e = 1; e < counts.cols(); ++e)
    more.rightCols(counts.cols() - e) += counts.leftCols(counts.cols() - e);
  return more;
}

void expect_moderate_count(std::size_t variables, const MonomialsOptions& options) {
  Matrix counts = Matrix::Zero(options.max_degree + 1, std::max(-options.min_degree, 0) + 1);
  counts(0, 0) = 1.0;
  const Index too_low = std::clamp<Index>(options.min_degree, 0, counts.rows());
  for (std::size_t v = 0; v < variables; ++v) {
    counts = with_one_more(counts);
    if (counts.bottomRows(counts.rows() - too_low).sum() > kMostTerms)
      throw ConfigError("monomials.max_degree",
                        "there are more than " + std::to_string(kMostTerms) + " monomials in " +
                            std::to_string(variables) + " variables",
                        "lower max_degree or leave variables out");
  }
}

/// Numbers by which monomials are ordered, the smaller the earlier: degree, size, and for each
/// variable in turn the largest power first, x before 1/x.
std::vector<int> rank(const Exponents& exponents) {
  std::vector<int> numbers{0, 0};
  for (const int e : exponents) {
    numbers[0] += e;
    numbers[1] += std::abs(e);
    numbers.push_back(-2 * std::abs(e) - (e > 0 ? 1 : 0));
  }
  return numbers;
}

/// Slots of the variables that take part.
std::vector<std::size_t> used_slots(const Variables& variables,
                                    const MonomialsOptions& options) {
  const std::size_t states = variables.states.size();
  const std::size_t inputs = variables.inputs.size();
  std::vector<std::size_t> slots(states + (options.with_inputs ? inputs : 0));
  std::iota(slots.begin(), slots.end(), std::size_t{0});
  if (options.with_time) slots.push_back(states + inputs);
  return slots;
}

std::vector<Term> monomial_terms(const Variables& variables, const MonomialsOptions& options) {
  const std::vector<std::size_t> slots = used_slots(variables, options);
  expect_moderate_count(slots.size(), options);
  ExponentLister lister(slots.size(), options.min_degree, options.max_degree);
  std::vector<std::pair<std::vector<int>, Exponents>> list;
  std::vector<Exponents> found = lister.list();
  for (Exponents& exponents : found) list.emplace_back(rank(exponents), std::move(exponents));
  std::sort(list.begin(), list.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Term> terms;
  terms.reserve(list.size());
  for (const auto& [ranked, exponents] : list) {
    Exponents all(static_cast<std::size_t>(variables.count()), 0);
    for (std::size_t i = 0; i < slots.size(); ++i) all[slots[i]] = exponents[i];
    terms.push_back(Term::monomial(all, variables));
  }
  return terms;
}

}  // namespace

std::vector<Term> Monomials::do_terms(const Variables& variables) const {
  const Options& o = options();
  if (o.min_degree > o.max_degree)
    throw ConfigError("monomials.min_degree",
                      "the lowest degree " + std::to_string(o.min_degree) +
                          " is above the highest, " + std::to_string(o.max_degree),
                      "give min_degree <= max_degree");
  std::vector<Term> terms = monomial_terms(variables, o);
  for (Term& term : parse_term_list("monomials.include", o.include, variables))
    terms.push_back(std::move(term));
  std::set<std::string> left_out;
  for (const Term& term : parse_term_list("monomials.exclude", o.exclude, variables))
    left_out.insert(term.name());
  std::erase_if(terms, [&](const Term& term) { return left_out.contains(term.name()); });
  return terms;
}

Stage<Basis> monomials(const MonomialsOptions& options) { return Monomials(options); }

}  // namespace lacuna
