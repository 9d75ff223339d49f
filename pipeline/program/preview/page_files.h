// The files of the live preview's page are a part of the program.
#pragma once

#include <span>
#include <string_view>

namespace domefall {

struct PageFile {
  std::string_view name;  // index.html and what it asks for
  std::string_view type;  // of its content, as HTTP has it
  std::string_view bytes;
};

// Returns the files of pipeline/program/preview/page, which the build turns into a source
// (embed_page.cmake).
std::span<const PageFile> page_files();

}  // namespace domefall
