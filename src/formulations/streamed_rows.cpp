// SPDX-License-Identifier: MIT
#include "streamed_rows.hpp"

#include <algorithm>
#include <utility>

#include "lacuna/core/error.hpp"
#include "lacuna/records/derived_record.hpp"

namespace lacuna {
namespace {

constexpr Index kPieceRows = Index{1} << 13;  // a fact of the machines: a piece stays in cache

void check_no_delay(const TermLibrary& library) {
  for (const Term& term : library.terms)
    if (contains(term.expression(), Operation::Delay))
      throw ConfigError("term " + term.name(), "long records are read in pieces without a past",
                        "leave the term out, or give a part of the record");
}

}  // namespace

class StreamedRows::Reader final : public RowReader {
 public:
  explicit Reader(const StreamedRows& source) : source_(source) {}

  void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
    for (Index done = 0; done < theta.rows();) {
      load(first + done);
      const Piece& piece = source_.pieces_[piece_];
      const Index skip = first + done - piece.first_row;
      const Index count = std::min(theta.rows() - done, piece.count - skip);
      reader_->read(skip, theta.middleRows(done, count), targets.middleRows(done, count));
      done += count;
    }
  }

 private:
  /// Makes the piece in which a row lies the one that is read.
  void load(Index row) {
    const auto& pieces = source_.pieces_;
    const auto behind =
        std::upper_bound(pieces.begin(), pieces.end(), row,
                         [](Index r, const Piece& piece) { return r < piece.first_row; });
    const auto number = static_cast<std::size_t>(behind - pieces.begin()) - 1;
    if (reader_ && number == piece_) return;
    reader_.reset();
    rows_.emplace(source_.rows_of_piece(pieces[number]));
    reader_ = rows_->open();
    piece_ = number;
  }

  const StreamedRows& source_;
  std::optional<LibraryRows> rows_;
  std::unique_ptr<RowReader> reader_;
  std::size_t piece_ = 0;
};

StreamedRows::StreamedRows(const TermLibrary& library,
                           std::vector<std::shared_ptr<const SampleSource>> records,
                           SampleRates rates, bool has_derivatives)
    : library_(library),
      records_(std::move(records)),
      rates_(std::move(rates)),
      has_derivatives_(has_derivatives),
      margin_(has_derivatives ? 0 : rates_.method->margin()) {
  check_no_delay(library);
  const Index fewest = has_derivatives ? 1 : rates_.method->fewest_samples();
  for (std::size_t record = 0; record < records_.size(); ++record) {
    const Index n = records_[record]->samples();
    if (n < fewest) continue;
    const Index ends = 4 * margin_ <= n ? margin_ : 0;
    for (Index first = ends; first < n - ends; first += kPieceRows) {
      const Index count = std::min(kPieceRows, n - ends - first);
      pieces_.push_back({record, first, rows_, count});
      rows_ += count;
    }
  }
}

std::unique_ptr<RowReader> StreamedRows::open() const {
  return std::make_unique<Reader>(*this);
}

LibraryRows StreamedRows::rows_of_piece(const Piece& piece) const {
  std::vector<Trajectory> samples;
  samples.push_back(samples_of_piece(piece));
  return {library_, samples};
}

Trajectory StreamedRows::samples_of_piece(const Piece& piece) const {
  const SampleSource& record = *records_[piece.record];
  if (has_derivatives_) return record.read(piece.first_sample, piece.count);
  const Index fewest = rates_.method->fewest_samples();
  // What the differentiator sees of a sample lies within its margin.
  const Index around = std::max(margin_, fewest);
  const Index first = std::max<Index>(piece.first_sample - around, 0);
  const Index end = std::min(piece.first_sample + piece.count + around, record.samples());
  const Trajectory samples =
      with_derivatives(record.read(first, end - first), *rates_.method, rates_.smooth_states);
  return rows_of(samples, piece.first_sample - first, piece.count);
}

std::optional<NonFiniteEntry> StreamedRows::find_non_finite() const {
  for (const Piece& piece : pieces_)
    if (auto entry = rows_of_piece(piece).find_non_finite()) {
      entry->sample += piece.first_sample;
      return entry;
    }
  return std::nullopt;
}

}  // namespace lacuna
