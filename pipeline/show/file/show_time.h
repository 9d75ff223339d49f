// People write times of a show as seconds, as minutes and seconds, or as the name of a marker.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/show/file/lookup.h"
#include "pipeline/show/file/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Returns the seconds of "M:SS", "M:SS.s" or "H:MM:SS", or nothing for any other text.
std::optional<double> parse_clock_time(std::string_view text);

// Writes seconds as "1:02.5", to the thousandth.
std::string clock_text(double seconds);

// Returns the seconds of a number, a clock time or a marker's name, or nothing for any other text.
std::optional<double> parse_time(std::string_view text, const std::vector<Marker>& markers);

// Reads `frames_per_second`, a number or a fraction such as 24000/1001.  A number that is a rounded
// rate of video, such as 23.98, becomes the rate itself, and the show keeps what was written.
void read_frame_rate(const Section& section, Show& show);

// Reads the show's `markers`, which are in the show or in a file of OpenTimelineIO.
std::vector<Marker> read_markers(const Section& show, const Lookup& lookup);

// Reads a time as parse_time does, in seconds since the show's second `start`.  Numbers and clock
// times count from there, and markers from the beginning of the show.
std::optional<double> read_time(const Item& item, const Range& range,
                                const std::vector<Marker>& markers = {}, double start = 0);

}  // namespace domefall
