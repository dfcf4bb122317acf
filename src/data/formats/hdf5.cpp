// SPDX-License-Identifier: MIT
#include "hdf5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/utf8.hpp"
#include "lacuna/core/base/error.hpp"
#include "named_arrays.hpp"

namespace lacuna {
namespace {

/// A number by which HDF5 knows something that is open, closed with this object.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  bool is_open() const noexcept { return id_ >= 0; }
  hid_t get() const noexcept { return id_; }

 private:
  hid_t id_;
  Close close_;
};

[[noreturn]] void fail(const std::string& source) {
  throw DataError(source, "the HDF5 file is damaged or cut short",
                  "make or copy the file again, or save the columns as .csv");
}

/// The file, out of its bytes in memory.
Handle open_file(std::string_view bytes, const std::string& source) {
  constexpr std::size_t kIncrement = std::size_t{1} << 20U;  // asked for; it never grows
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), kIncrement, 0);
  H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size());  // is copied
  // A name that no file has.
  return {H5Fopen((source + "/in memory").c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

/// The file in its place. Without a lock, which some file systems do not have.
Handle open_file(const std::filesystem::path& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(access.get(), false, true);
#endif
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

/// Rows and columns of a data set; no columns where it has more dimensions.
std::pair<hsize_t, hsize_t> extent_of(const Handle& set) {
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank != 1 && rank != 2) return {0, 0};
  hsize_t sizes[2] = {0, 1};
  H5Sget_simple_extent_dims(space.get(), sizes, nullptr);
  return {sizes[0], sizes[1]};
}

bool has_real_numbers(const Handle& set) {
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// How many rows, or columns, of a data set are packed together; 1 where none are.
Index packed_together(const Handle& set, bool columns) {
  const Handle made(H5Dget_create_plist(set.get()), H5Pclose);
  hsize_t sizes[2] = {1, 1};
  if (H5Pget_layout(made.get()) != H5D_CHUNKED || H5Pget_chunk(made.get(), 2, sizes) < 1)
    return 1;
  return static_cast<Index>(sizes[columns ? 1 : 0]);
}

/// What is found in a file.
struct Found {
  std::vector<ArrayShape> shapes;  ///< of the data sets that are arrays of numbers
  std::vector<Handle> sets;        ///< these
  std::vector<std::string> notes;  ///< what is omitted
};

/// How links are followed: never into other files, which a record has no business to name.
Handle inside_the_file() {
  Handle access(H5Pcreate(H5P_LINK_ACCESS), H5Pclose);
  const H5L_elink_traverse_t refuse = [](const char*, const char*, const char*, const char*,
                                         unsigned*, hid_t, void*) -> herr_t { return -1; };
  H5Pset_elink_cb(access.get(), refuse, nullptr);
  return access;
}

/// What the value of a soft or external link says.
std::string target_of(const Handle& group, const char* link, std::size_t size,
                      const std::string& source) {
  constexpr std::size_t kLongest = std::size_t{1} << 16U;  // bytes; a longer path is damage
  std::string value(std::min(size, kLongest), '\0');
  if (size > kLongest ||
      H5Lget_val(group.get(), link, value.data(), value.size(), H5P_DEFAULT) < 0)
    fail(source);
  return value;
}

/// @throws DataError where it leads to another file.
void note_soft_link(const Handle& group, const char* link, const std::string& name,
                    const H5L_info_t& info, const std::string& source, Found& found) {
  const std::string value = target_of(group, link, info.u.val_size, source);
  if (info.type != H5L_TYPE_SOFT)
    throw DataError(source, "'" + name + "' is a link to another file, which is not followed",
                    "copy what it leads to into this file (h5copy)");
  const Handle access = inside_the_file();
  const bool leads = H5Oexists_by_name(group.get(), link, access.get()) > 0;
  const std::string target = printable(value.substr(0, value.find('\0')));
  found.notes.push_back("the link '" + name + "' leads to '" + target + "', " +
                        (leads ? "which is read by its own name" : "where nothing is"));
}

std::string not_numbers(const std::string& name) {
  return "the data set '" + name +
         "' is neither a vector nor a matrix of real numbers and is left out";
}

/// Where the numbers of a data set stand.
enum class Storage {
  Here,    ///< in the data set itself
  Others,  ///< in other data sets of this file (a virtual one), which have names of their own
};

/// @throws DataError where that is another file, which a record has no business to name.
Storage storage_of(const Handle& set, const std::string& name, const std::string& source) {
  const auto refuse = [&] {
    throw DataError(source,
                    "the data set '" + name +
                        "' keeps its numbers in another file, which is not read",
                    "copy them into this file (h5repack -l CONTI)");
  };
  const Handle made(H5Dget_create_plist(set.get()), H5Pclose);
  if (!made.is_open()) fail(source);
  if (H5Pget_external_count(made.get()) != 0) refuse();
  if (H5Pget_layout(made.get()) != H5D_VIRTUAL) return Storage::Here;
  std::size_t parts = 0;
  if (H5Pget_virtual_count(made.get(), &parts) < 0) fail(source);
  for (std::size_t i = 0; i < parts; ++i) {
    char file[2] = "";  // "." is this file
    const ssize_t size = H5Pget_virtual_filename(made.get(), i, file, sizeof file);
    if (size < 0) fail(source);
    if (size != 1 || file[0] != '.') refuse();
  }
  return Storage::Others;
}

void collect_set(Handle set, const std::string& name, const std::string& source, Found& found) {
  if (storage_of(set, name, source) == Storage::Others) {
    found.notes.push_back("the data set '" + name +
                          "' is put together from others, which are read by their own names");
    return;
  }
  const auto [rows, columns] = extent_of(set);
  if (columns == 0 || !has_real_numbers(set)) {
    found.notes.push_back(not_numbers(name));
    return;
  }
  found.shapes.push_back({name, static_cast<Index>(rows), static_cast<Index>(columns)});
  found.sets.push_back(std::move(set));
}

/// Data sets of a group and of the groups in it.
void collect_group(const Handle& group, const std::string& before, int depth,
                   const std::string& source, Found& found) {
  constexpr int kDeepest = 16;  // links may lead in a circle
  H5G_info_t info{};
  if (depth > kDeepest || H5Gget_info(group.get(), &info) < 0) fail(source);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char link[1024] = "";
    if (H5Lget_name_by_idx(group.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link,
                           H5P_DEFAULT) < 0)
      fail(source);
    if (link[0] == '#') continue;  // MATLAB's own: contents of cells
    const std::string name = before + link;
    H5L_info_t kind_of_link{};
    if (H5Lget_info(group.get(), link, &kind_of_link, H5P_DEFAULT) < 0) fail(source);
    if (kind_of_link.type != H5L_TYPE_HARD) {
      note_soft_link(group, link, name, kind_of_link, source, found);
      continue;
    }
    Handle object(H5Oopen(group.get(), link, H5P_DEFAULT), H5Oclose);
    const H5I_type_t kind = object.is_open() ? H5Iget_type(object.get()) : H5I_BADID;
    if (kind == H5I_GROUP)
      collect_group(object, name + ".", depth + 1, source, found);
    else if (kind == H5I_DATASET)
      collect_set(std::move(object), name, source, found);
    else
      found.notes.push_back(not_numbers(name));
  }
}

/// The arrays of an open file as rows.
class ArrayRows {
 public:
  ArrayRows(Handle file, std::string source, const TimeFinder& find)
      : file_(std::move(file)), source_(std::move(source)) {
    if (!file_.is_open()) fail(source_);
    const Handle root(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose);
    if (!root.is_open()) fail(source_);
    collect_group(root, "", 0, source_, found_);
    all_ = arrange_arrays(found_.shapes, source_);
    for (const std::string& note : found_.notes)
      all_.table.notes.push_back(source_ + ": " + note);
    if (const auto time = find(all_.table)) look_at(*time);
  }

  Index samples() const { return all_.samples; }
  const Table& columns() const { return all_.table; }

  /// Most samples that are unpacked together.
  Index together() const {
    Index most = 1;
    for (const ArrayPlace& place : all_.places)
      most = std::max(most, packed_together(found_.sets[place.array], place.in_columns));
    return most;
  }

  /// Samples [first, first + count), which must be there.
  Matrix read(Index first, Index count) const {
    Matrix values(count, static_cast<Index>(all_.table.columns.size()));
    for (const ArrayPlace& place : all_.places) {
      auto block = values.middleCols(place.first_column, place.columns);
      if (place.in_columns)
        block = part_of(place, {0, first}, {place.columns, count}).transpose();
      else
        block = part_of(place, {first, 0}, {count, place.columns});
    }
    if (!origin_) return values;
    const std::vector<Stamp> stamps = stamps_of(all_.table.counted->column, first, count);
    for (Index row = 0; row < count; ++row)
      values(row, all_.table.counted->column) =
          value_of(stamps[static_cast<std::size_t>(row)] - *origin_);
    return values;
  }

 private:
  template <class Number>
  using Values = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  struct Pair {
    Index rows = 0, columns = 0;
  };

  /// Looks at the first times, which are counted from the first one where that is needed.
  void look_at(const TimeColumn& time) {
    const Index looked = std::min(samples(), kFirstTimes);
    const Handle type(H5Dget_type(found_.sets[place_of(all_, time.column).array].get()),
                      H5Tclose);
    if (H5Tget_class(type.get()) == H5T_INTEGER) {
      origin_ = look_at_times(all_.table, time, stamps_of(time.column, 0, looked));
    } else {
      const Vector first = read(0, looked).col(time.column);
      const double epsilon = H5Tget_size(type.get()) < sizeof(double)
                                 ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                 : std::numeric_limits<double>::epsilon();
      look_at_times(all_.table, time, {first.data(), static_cast<std::size_t>(looked)},
                    epsilon);
    }
  }

  /// Samples [first, first + count) of a column of whole numbers, as they are written.
  std::vector<Stamp> stamps_of(Index column, Index first, Index count) const {
    const ArrayPlace& place = place_of(all_, column);
    const Index line = column - place.first_column;
    const Pair begin = place.in_columns ? Pair{line, first} : Pair{first, line};
    const Pair size = place.in_columns ? Pair{1, count} : Pair{count, 1};
    const Handle type(H5Dget_type(found_.sets[place.array].get()), H5Tclose);
    std::vector<Stamp> stamps;
    const auto add = [&](const auto& numbers) {
      for (Index i = 0; i < count; ++i) stamps.push_back(stamp_of(numbers.data()[i]));
    };
    if (H5Tget_sign(type.get()) == H5T_SGN_NONE)
      add(part_of<std::uint64_t>(place, begin, size, H5T_NATIVE_UINT64));
    else
      add(part_of<std::int64_t>(place, begin, size, H5T_NATIVE_INT64));
    return stamps;
  }

  Values<double> part_of(const ArrayPlace& place, Pair first, Pair size) const {
    return part_of<double>(place, first, size, H5T_NATIVE_DOUBLE);
  }

  template <class Number>
  Values<Number> part_of(const ArrayPlace& place, Pair first, Pair size, hid_t type) const {
    const Handle& set = found_.sets[place.array];
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    const hsize_t from[2] = {static_cast<hsize_t>(first.rows),
                             static_cast<hsize_t>(first.columns)};
    const hsize_t counts[2] = {static_cast<hsize_t>(size.rows),
                               static_cast<hsize_t>(size.columns)};
    const Handle target(H5Screate_simple(rank, counts, nullptr), H5Sclose);
    Values<Number> values(size.rows, size.columns);
    if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, from, nullptr, counts, nullptr) < 0 ||
        H5Dread(set.get(), type, target.get(), space.get(), H5P_DEFAULT, values.data()) < 0)
      fail(source_);
    return values;
  }

  Handle file_;
  std::string source_;
  Found found_;
  ArrayTable all_;
  std::optional<Stamp> origin_;  ///< from which the times are counted
};

class Hdf5Blocks final : public RowBlocks {
 public:
  Hdf5Blocks(const std::filesystem::path& path, BlockSizes sizes, const TimeFinder& find)
      : rows_(open_file(path), path.string(), find) {
    // A block that is smaller than what is packed together has all of that unpacked.
    const std::size_t row = rows_.columns().columns.size() * sizeof(double);
    const auto most = static_cast<Index>(sizes.longest / row);
    count_ = std::max<Index>(
        {static_cast<Index>(sizes.block / row), std::min(rows_.together(), most), 1});
  }

  const Table& columns() const override { return rows_.columns(); }

  bool next(Table& block) override {
    const Index count = std::min(count_, rows_.samples() - first_);
    if (count == 0) return false;
    block.values = rows_.read(first_, count);
    first_ += count;
    return true;
  }

  std::optional<double> fraction() const override {
    return static_cast<double>(first_) / static_cast<double>(rows_.samples());
  }

 private:
  ArrayRows rows_;
  Index count_ = 1;  ///< of a block
  Index first_ = 0;  ///< of the next block
};

void report_errors_ourselves() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

}  // namespace

Table parse_hdf5(std::string_view bytes, const std::string& source, const TimeFinder& find) {
  report_errors_ourselves();
  const ArrayRows rows(open_file(bytes, source), source, find);
  Table table = rows.columns();
  table.values = rows.read(0, rows.samples());
  return table;
}

std::unique_ptr<RowBlocks> hdf5_blocks(const std::filesystem::path& path, BlockSizes sizes,
                                       const TimeFinder& find) {
  report_errors_ourselves();
  return std::make_unique<Hdf5Blocks>(path, sizes, find);
}

}  // namespace lacuna
