// These are the files of a delivery as they lie on the disk, and what others have left among them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// Systems, file managers and storage appliances leave files and folders of these names on every
// disk and share that they meet.  They are written in small letters, and compared without regard to
// those of ASCII.  The last two are a Macintosh's Icon with its carriage return, as it is and as
// file servers write it.
inline constexpr std::string_view kLeftBehind[] = {"thumbs.db",
                                                   "ehthumbs.db",
                                                   "ehthumbs_vista.db",
                                                   "desktop.ini",
                                                   "$recycle.bin",
                                                   "recycler",
                                                   "recycled",
                                                   "found.000",
                                                   "system volume information",
                                                   "wpsettings.dat",
                                                   "indexervolumeguid",
                                                   "__macosx",
                                                   "temporary items",
                                                   "network trash folder",
                                                   "thevolumesettingsfolder",
                                                   "thefindbycontentfolder",
                                                   "@eadir",
                                                   "#recycle",
                                                   "@recycle",
                                                   "@recently-snapshot",
                                                   "lost+found",
                                                   "lost.dir",
                                                   "icon\r",
                                                   "icon\xEF\x80\x8D"};

// A stream of Windows that became a file of its own ends in one of these, after its file's name.
inline constexpr std::string_view kLeftBehindEnds[] = {":zone.identifier", ":encryptable"};

// Says whether a file or folder of this name was left behind by others.  Hidden ones, whose names
// begin with a dot, are among them.
bool is_left_behind(std::string_view name);

// FolderFiles are paths below a folder, with '/' and sorted.
struct FolderFiles {
  std::vector<std::string> files;
  std::vector<std::string> left_behind;  // folders end with '/', and what is in them is not named
};

// Returns all files in the folder and in those below it, links and special files among them.  A
// folder that is missing has no files.  Throws TemporaryError where a folder cannot be read.
FolderFiles files_below(const std::filesystem::path& folder);

}  // namespace domefall
