#include "pipeline/report/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "pipeline/image/errors.h"

namespace domefall {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "domefall-report.XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw TemporaryError(name + ": no temporary folder can be made");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace domefall
