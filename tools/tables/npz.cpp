// Tables as NumPy's .npz: an archive of arrays, which numpy.load reads. The formats are those of
// numpy.lib.format, version 1.0, and of ZIP, which libzip writes.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/tables/table.hpp"
#ifdef CASIMIR_LIBZIP
#include <zip.h>
#endif

namespace casimir::tools {

#ifdef CASIMIR_LIBZIP

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are said to be '<f8'");

/// The code points of a text. \return U+FFFD in the place of bytes that are no UTF-8
std::u32string code_points(const std::string& text) {
  std::u32string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80              ? 0
                     : (lead & 0xe0U) == 0xc0 ? 1
                     : (lead & 0xf0U) == 0xe0 ? 2
                     : (lead & 0xf8U) == 0xf0 ? 3
                                              : -1;
    char32_t point = more <= 0 ? lead : lead & (0x3fU >> static_cast<unsigned>(more));
    bool whole = more >= 0;
    for (int k = 0; whole && k < more; ++k) {
      whole = i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80;
      if (whole) point = (point << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3fU);
    }
    result.push_back(whole ? point : U'\ufffd');
  }
  return result;
}

/// The bytes of an array: a head that says what they are, then the cells.
std::string npy(const std::string& type, const std::vector<std::size_t>& shape, const void* cells,
                std::size_t bytes) {
  std::string sizes;
  for (const std::size_t n : shape) sizes += std::to_string(n) + ",";
  std::string head = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type,
                                 shape.empty() ? "" : sizes);
  constexpr std::size_t kBefore = 10;  // the magic string, the version and the length
  head += std::string(63 - (kBefore + head.size()) % 64, ' ') + '\n';
  std::string result = "\x93NUMPY";
  result += '\x01';
  result += '\x00';
  result += static_cast<char>(head.size() & 0xffU);
  result += static_cast<char>(head.size() >> 8U);
  result += head;
  const std::size_t start = result.size();
  result.resize(start + bytes);
  if (bytes > 0) std::memcpy(result.data() + start, cells, bytes);
  return result;
}

/// The bytes of a column's array.
class Bytes {
 public:
  explicit Bytes(std::vector<std::size_t> shape) : shape_(std::move(shape)) {}

  std::string operator()(const std::vector<double>& cells) const {
    return npy("<f8", shape_, cells.data(), 8 * cells.size());
  }
  std::string operator()(const std::vector<std::int64_t>& cells) const {
    return npy("<i8", shape_, cells.data(), 8 * cells.size());
  }
  std::string operator()(const std::vector<std::optional<double>>& cells) const {
    std::vector<double> numbers;
    for (const auto& cell : cells)
      numbers.push_back(cell.value_or(std::numeric_limits<double>::quiet_NaN()));
    return (*this)(numbers);
  }
  std::string operator()(const std::vector<std::string>& cells) const {
    std::vector<std::u32string> texts;
    for (const std::string& cell : cells) texts.push_back(code_points(cell));
    return text(
        texts.size(), [&](std::size_t row) -> const auto& { return texts[row]; });
  }
  std::string operator()(const Choices& cells) const {
    std::vector<std::u32string> words;
    for (const std::string& word : cells.words) words.push_back(code_points(word));
    return text(
        cells.rows.size(), [&](std::size_t row) -> const auto& {
          return words[static_cast<std::size_t>(cells.rows[row])];
        });
  }

 private:
  /// Of one width, with zeros behind shorter ones.
  template <class At>
  std::string text(std::size_t rows, const At& at) const {
    std::size_t width = 1;
    for (std::size_t row = 0; row < rows; ++row) width = std::max(width, at(row).size());
    std::u32string all;
    all.reserve(rows * width);
    for (std::size_t row = 0; row < rows; ++row) {
      all += at(row);
      all.resize((row + 1) * width);
    }
    return npy(fmt::format("<U{}", width), shape_, all.data(), 4 * all.size());
  }

  std::vector<std::size_t> shape_;
};

/// The array that says why rows are missing.
const std::string kNote = "note";

[[noreturn]] void no_archive() { throw SystemError("libzip could not write the archive"); }

/// An archive that grows in memory, so that nothing but the file of the command is on the disk.
class Archive {
 public:
  Archive() {
    zip_error_t error;
    zip_error_init(&error);
    memory_.reset(zip_source_buffer_create(nullptr, 0, 0, &error));
    if (!memory_) no_archive();
    zip_source_keep(memory_.get());
    archive_ = zip_open_from_source(memory_.get(), ZIP_TRUNCATE, &error);
    zip_error_fini(&error);
    if (archive_ == nullptr) {
      zip_source_free(memory_.get());
      no_archive();
    }
  }
  ~Archive() {
    if (archive_ != nullptr) zip_discard(archive_);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// \param bytes  have to stay until `write`
  void add(const std::string& name, const std::string& bytes) {
    zip_source_t* source = zip_source_buffer(archive_, bytes.data(), bytes.size(), 0);
    if (source == nullptr) no_archive();
    const zip_int64_t place =
        zip_file_add(archive_, name.c_str(), source, ZIP_FL_ENC_UTF_8 | ZIP_FL_OVERWRITE);
    if (place < 0) {
      zip_source_free(source);
      no_archive();
    }
    const auto index = static_cast<zip_uint64_t>(place);
    constexpr zip_uint16_t kFirstDay = 0x21;  // 1 January 1980, where the format's calendar begins
    if (zip_set_file_compression(archive_, index, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(archive_, index, 0, kFirstDay, 0) != 0)
      no_archive();
  }

  void write(std::ostream& out) {
    if (zip_close(archive_) != 0) no_archive();
    archive_ = nullptr;
    zip_source_t* const source = memory_.get();
    if (zip_source_open(source) != 0) no_archive();
    std::vector<char> part(1 << 16);
    zip_int64_t read = 0;
    while ((read = zip_source_read(source, part.data(), part.size())) > 0)
      out.write(part.data(), read);
    zip_source_close(source);
    if (read < 0) no_archive();
  }

 private:
  struct Free {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
  };
  std::unique_ptr<zip_source_t, Free> memory_;
  zip_t* archive_ = nullptr;
};

}  // namespace

bool has_libzip() { return true; }

void write_npz(const std::string& path, const Table& table) {
  OutputFile file(path);
  const std::vector<std::string> names = array_names(table);
  std::vector<std::string> arrays;
  arrays.reserve(names.size() + 1);  // they may not move while the archive refers to them
  Archive archive;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Column& column = table.columns[k];
    const auto shape =
        column.shape.empty() ? std::vector<std::size_t>{column.size()} : column.shape;
    arrays.push_back(std::visit(Bytes(shape), column.cells));
    archive.add(names[k] + ".npy", arrays.back());
  }
  if (!table.note.empty() && std::ranges::count(names, kNote) == 0) {
    arrays.push_back(Bytes({})(std::vector<std::string>{table.note}));
    archive.add(kNote + ".npy", arrays.back());
  }
  archive.write(file.stream());
  file.commit();
}

#else

bool has_libzip() { return false; }

void write_npz(const std::string& path, const Table&) { check_table_name(path); }

#endif

}  // namespace casimir::tools
