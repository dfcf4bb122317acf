// SPDX-License-Identifier: MIT
#include "streamed_rows.hpp"

#include <algorithm>
#include <utility>

#include "core/numerics/column_kernels.hpp"
#include "lacuna/core/base/error.hpp"
#include "records/binding/derived_record.hpp"
#include "variable_slots.hpp"

namespace lacuna {
namespace {

constexpr Index kPieceRows = Index{1} << 13;  // a fact of the machines: a piece stays in cache

void check_no_delay(const TermLibrary& library) {
  for (const Term& term : library.terms)
    if (contains(term.expression(), Operation::Delay))
      throw ConfigError("term " + term.name(), "long records are read in pieces without a past",
                        "leave the term out, or give a part of the record");
}

/// Copies rows first, first + 1, ... @return whether all values are finite.
bool copy_rows(const Matrix& from, Index first, Eigen::Ref<Matrix> to) {
  bool finite = true;
  for (Index j = 0; j < to.cols(); ++j)
    finite &= copy_finite(from.col(j).data() + first, to.rows(), to.col(j).data());
  return finite;
}

}  // namespace

/// Rows are made of the samples of one piece after the other.
class StreamedRows::Reader final : public RowReader {
 public:
  explicit Reader(const StreamedRows& source)
      : source_(source), program_(source.library_.compile()) {}

  void read(Index first, Eigen::Ref<Matrix> theta, Eigen::Ref<Matrix> targets) override {
    for (Index done = 0; done < theta.rows();) {
      load(first + done);
      const Index skip = first + done - piece_->first_row;
      const Index count = std::min(theta.rows() - done, piece_->count - skip);
      slots_.resize(count, program_.slots());
      const bool variables = fill_variables(*samples_, begin_ + skip, slots_);
      const bool rates =
          copy_rows(samples_->derivatives, begin_ + skip, targets.middleRows(done, count));
      // What no term uses would not be seen in the rows.
      if (!variables || !rates)
        throw DataError("data", "a value is not finite",
                        "split the record there or remove the row");
      program_.evaluate(slots_, theta.middleRows(done, count), workspace_);
      average_at(input_jumps(*samples_, begin_ + skip, slots_, source_.held_), program_, 0,
                 theta.middleRows(done, count), workspace_);
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
    const Piece* piece = &*(behind - 1);
    if (piece == piece_) return;
    piece_ = piece;
    const Trajectory* whole = source_.records_[piece->record]->in_memory();
    if (whole && source_.has_derivatives_) {
      samples_ = whole;
      begin_ = piece->first_sample;
    } else {
      begin_ = std::min<Index>(1, piece->first_sample);  // a jump shows in the sample before
      own_ = source_.samples_of_piece(*piece, begin_);
      samples_ = &own_;
    }
  }

  const StreamedRows& source_;
  Program program_;
  Program::Workspace workspace_;
  Matrix slots_;
  const Piece* piece_ = nullptr;
  Trajectory own_;
  const Trajectory* samples_ = nullptr;  ///< of the piece, from begin_ on
  Index begin_ = 0;
};

StreamedRows::StreamedRows(const TermLibrary& library,
                           std::vector<std::shared_ptr<const SampleSource>> records,
                           SampleRates rates, bool has_derivatives, std::vector<Index> held)
    : library_(library),
      records_(std::move(records)),
      rates_(std::move(rates)),
      has_derivatives_(has_derivatives),
      held_(std::move(held)),
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

Trajectory StreamedRows::samples_of_piece(const Piece& piece, Index more) const {
  const SampleSource& record = *records_[piece.record];
  const Index begin = piece.first_sample - more, count = piece.count + more;
  if (has_derivatives_) return record.read(begin, count);
  const Index fewest = rates_.method->fewest_samples();
  // What the differentiator sees of a sample lies within its margin.
  const Index around = std::max(margin_, fewest);
  const Index first = std::max<Index>(begin - around, 0);
  const Index end = std::min(piece.first_sample + piece.count + around, record.samples());
  const Trajectory samples =
      with_derivatives(record.read(first, end - first), *rates_.method, rates_.smooth_states);
  return rows_of(samples, begin - first, count);
}

std::optional<NonFiniteEntry> StreamedRows::find_non_finite() const {
  for (const Piece& piece : pieces_) {
    auto entry = LibraryRows(library_, {samples_of_piece(piece, 0)}).find_non_finite();
    if (!entry) continue;
    entry->sample += piece.first_sample;
    return entry;
  }
  return std::nullopt;
}

}  // namespace lacuna
