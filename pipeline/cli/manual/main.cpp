// This program writes the manual pages and the bash completion of domefall into a folder, when the
// build calls it as domefall_make_manual DATE FOLDER.

#include <cstdio>
#include <exception>

#include "pipeline/cli/manual/make_manual.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: domefall_make_manual DATE FOLDER\n", stderr);
    return 2;
  }
  try {
    domefall::make_manual(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
