// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "diabolo/text/error.hpp"

namespace diabolo {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

/// The whole content of a regular file. Throws RecordingError where there is none, or it cannot be read.
inline std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::none)  // such as in a folder that may not be entered
    throw RecordingError(path.string() + ": the file cannot be reached: " + error.message());
  if (!std::filesystem::exists(status)) throw RecordingError(path.string() + ": there is no such file");
  if (std::filesystem::is_directory(status))
    throw RecordingError(path.string() + ": a directory; expected a file");
  if (!std::filesystem::is_regular_file(status))
    throw RecordingError(path.string() + ": a device or a pipe; expected a file");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw RecordingError(
        path.string() + ": the file cannot be opened for reading: " + std::generic_category().message(errno));
  std::string content(std::filesystem::file_size(path, error), '\0');
  if (error || std::fread(content.data(), 1, content.size(), file.get()) != content.size())
    throw RecordingError(path.string() + ": the file cannot be read");
  return content;
}

/// Where a file is that a symbolic link, or one behind it, leads to; there need be none. Throws
/// RecordingError where they lead nowhere.
inline std::filesystem::path behind_links(const std::filesystem::path& path) {
  constexpr int kMostLinks = 40;
  std::filesystem::path place = path;
  std::error_code ignored;
  for (int i = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(place, ignored)); ++i) {
    if (i == kMostLinks)
      throw RecordingError(path.string() + ": a symbolic link that leads to itself; expected a file");
    place = place.parent_path() / std::filesystem::read_symlink(place, ignored);
  }
  return place;
}

/// Files that appear whole or not at all: each is written under a temporary name beside its place, and
/// commit() renames them all. Without commit() nothing is left behind.
class FilesToWrite {
 public:
  FilesToWrite() = default;
  FilesToWrite(const FilesToWrite&) = delete;
  FilesToWrite& operator=(const FilesToWrite&) = delete;
  ~FilesToWrite() {
    std::error_code ignored;
    for (const Pending& file : pending_) std::filesystem::remove(file.temporary, ignored);
  }

  /// Throws RecordingError where the content cannot be written (no such folder, no file, disk full).
  void add(const std::filesystem::path& path, std::string_view content) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status))
      throw RecordingError(path.string() + ": a directory; expected a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      throw RecordingError(path.string() + ": a device or a pipe; expected a file");
    const std::filesystem::path place = behind_links(path);
    std::filesystem::path temporary = place;
    temporary += ".tmp" + std::to_string(std::random_device()());
    File file(std::fopen(temporary.c_str(), "wbx"));
    if (!file)
      throw RecordingError(path.string() +
                           ": the file cannot be written there: " + std::generic_category().message(errno));
    pending_.push_back({temporary, place});
    const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
    if (std::fclose(file.release()) != 0 || !written)
      throw RecordingError(path.string() + ": the file cannot be written (is the disk full?)");
  }

  /// Throws RecordingError where a name cannot be taken.
  void commit() {
    for (const Pending& file : pending_) {
      std::error_code error;
      std::filesystem::rename(file.temporary, file.path, error);
      if (error)
        throw RecordingError(file.path.string() + ": the file cannot be replaced: " + error.message());
    }
    pending_.clear();
  }

 private:
  struct Pending {
    std::filesystem::path temporary, path;
  };
  std::vector<Pending> pending_;
};

}  // namespace diabolo
