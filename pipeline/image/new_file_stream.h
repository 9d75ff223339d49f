// A file in the making as OpenEXR writes it.  OpenEXR sees no errors of the disk: commit() throws
// them with the system's own reason.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <string>

#include "pipeline/image/new_file.h"

namespace domefall {

class NewFileStream : public Imf::OStream {
 public:
  NewFileStream(NewFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}

  void write(const char c[], int n) override { file_.write({c, static_cast<std::size_t>(n)}); }
  uint64_t tellp() override { return file_.position(); }
  // OpenEXR goes back to fill in its offset table, and to the end again.
  void seekp(uint64_t position) override { file_.seek(position); }

 private:
  NewFile& file_;
};

}  // namespace domefall
