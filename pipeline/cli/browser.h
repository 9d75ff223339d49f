// These functions concern the desktop and the name of this machine.
#pragma once

#include <string>

namespace domefall {

// Opens an address in the browser of this desktop, and does nothing where there is no desktop.
void open_browser(const std::string& url);

// Returns the name by which others may know this machine, or HOST if the system does not tell.
std::string host_name();

}  // namespace domefall
