// SPDX-License-Identifier: MIT
#include <utility>

#include "core/base/utf16.hpp"
#include "lacuna/core/base/error.hpp"
#include "row_blocks.hpp"
#include "text_rows.hpp"

namespace lacuna {
namespace {

/// A text of which a part is in memory.
class PartOfText {
 public:
  PartOfText(std::unique_ptr<OpenedFile> file, BlockSizes sizes)
      : file_(std::move(file)), sizes_(sizes), text_(std::exchange(file_->begin, {})) {
    is_all_ = text_.size() < TextFormat::kBegin;
    decode_ = Utf16Decoder::for_text(text_);
    if (decode_) text_ = (*decode_)(text_);
  }

  const OpenedFile& file() const { return *file_; }
  const std::string& text() const { return text_; }

  /// Whether nothing comes behind it.
  bool is_all() const { return is_all_; }

  void drop(std::size_t count) { text_.erase(0, count); }

  /// Adds so many bytes.
  /// @throws DataError where that is more than a line may have.
  void add(std::size_t count) {
    if (text_.size() > sizes_.longest)
      throw DataError(file_->source,
                      "a line, or what is in front of the numbers, has more than " +
                          std::to_string(sizes_.longest >> 10U) + " kB",
                      "check that it is a record; raise --memory, or leave it out");
    std::string bytes(count, '\0');
    bytes.resize(file_->stream.read(bytes));
    is_all_ = bytes.size() < count;
    text_ += decode_ ? (*decode_)(bytes) : bytes;
  }

 private:
  std::unique_ptr<OpenedFile> file_;
  BlockSizes sizes_;
  std::optional<Utf16Decoder> decode_;
  std::string text_;
  bool is_all_ = false;
};

/// Looked for in so much of the text as shows it.
TextFormat format_of(PartOfText& part) {
  while (true) {
    if (auto format = find_format(part.text(), part.is_all(), part.file().source))
      return *format;
    part.add(part.text().size());
  }
}

class TextBlocks final : public RowBlocks {
 public:
  TextBlocks(std::unique_ptr<OpenedFile> file, BlockSizes sizes, const TimeFinder& find)
      : part_(std::move(file), sizes),
        block_(sizes.block),
        rows_(format_of(part_), part_.file().source, find) {}

  const Table& columns() const override { return rows_.columns(); }

  bool next(Table& block) override {
    if (has_ended_) return false;
    std::string_view lines = available();
    while (lines.empty() && !part_.is_all()) {
      part_.add(block_);
      lines = available();
    }
    has_ended_ = part_.is_all();
    rows_.read(lines, block, has_ended_ && is_first_);
    is_first_ = false;
    if (has_ended_) rows_.finish();
    part_.drop(lines.size());
    return true;
  }

  std::optional<double> fraction() const override { return part_.file().stream.fraction(); }

 private:
  /// Whole lines, and the rest where the text has ended.
  std::string_view available() const {
    return part_.is_all() ? std::string_view(part_.text())
                          : whole_lines(part_.text(), rows_.line_end());
  }

  PartOfText part_;
  std::size_t block_;
  TextRows rows_;
  bool is_first_ = true;
  bool has_ended_ = false;
};

}  // namespace

std::unique_ptr<RowBlocks> text_blocks(std::unique_ptr<OpenedFile> file, BlockSizes sizes,
                                       const TimeFinder& find) {
  return std::make_unique<TextBlocks>(std::move(file), sizes, find);
}

}  // namespace lacuna
