// A file in the making as the two image libraries write it.  They know nothing of what goes wrong with it:
// that is told when the file is committed, by the system's own reason.
#pragma once

#include <OpenEXR/ImfIO.h>
#include <OpenImageIO/filesystem.h>

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

class NewFileProxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit NewFileProxy(NewFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const override { return "NewFile"; }
  int64_t tell() override { return static_cast<int64_t>(file_.position()); }
  bool seek(int64_t offset) override {
    file_.seek(static_cast<std::uint64_t>(offset));
    return true;
  }
  size_t write(const void* bytes, size_t count) override {
    file_.write({static_cast<const char*>(bytes), count});
    return count;
  }
  size_t size() const override { return file_.size(); }

 protected:
  NewFile& file() { return file_; }

 private:
  NewFile& file_;
};

}  // namespace domefall
