// The browser of whoever sits at this machine.
#pragma once

#include <string>

namespace domefall {

// Opens an address, where there is a desktop with a browser; nothing happens where there is none.
void open_browser(const std::string& url);

// The name of this machine, as others may know it.
std::string host_name();

}  // namespace domefall
