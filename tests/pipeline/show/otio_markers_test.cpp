// Markers of the show out of a timeline that another program has edited.
#include "pipeline/show/file/otio_markers.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

std::string time(double value, double rate = 24) {
  return R"({"OTIO_SCHEMA": "RationalTime.1", "rate": )" + std::to_string(rate) + R"(, "value": )" +
         std::to_string(value) + "}";
}
std::string range(double start, double length) {
  return R"({"OTIO_SCHEMA": "TimeRange.1", "start_time": )" + time(start) + R"(, "duration": )" +
         time(length) + "}";
}
std::string marker(const std::string& name, double at) {
  return R"({"OTIO_SCHEMA": "Marker.2", "name": ")" + name + R"(", "marked_range": )" +
         range(at, 1) + "}";
}
std::string item(const std::string& kind, const std::string& name, const std::string& rest) {
  return R"({"OTIO_SCHEMA": ")" + kind + R"(", "name": ")" + name + "\", " + rest + "}";
}
std::string timeline(const std::string& markers, const std::string& children) {
  return item(
      "Timeline.1", "cut",
      R"("tracks": )" + item("Stack.1", "tracks",
                             R"("markers": [)" + markers + R"(], "children": [)" +
                                 item("Track.1", "V1", R"("children": [)" + children + "]") + "]"));
}

std::vector<Marker> read(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "markers_test.otio";
  std::ofstream(file) << text;
  return read_otio_markers(file);
}

TEST(OtioMarkers, CountFromTheBeginningOfTheTimeline) {
  const auto markers =
      read(timeline(marker("hit", 120) + "," + marker("hit", 12),
                    item("Clip.2", "opening",
                         R"("source_range": )" + range(1000, 48) + R"(, "markers": [)" +
                             marker("door", 1024) + "]") +
                        "," + item("Transition.1", "", R"("in_offset": )" + time(6)) + "," +
                        item("Gap.1", "", R"("source_range": )" + range(0, 24)) + "," +
                        item("Clip.1", "opening",
                             R"("source_range": null, "media_reference": {"available_range": )" +
                                 range(0, 10) + "}") +
                        "," + item("Clip.1", "", R"("source_range": )" + range(0, 24))));
  const std::vector<std::pair<std::string, double>> expected{
      {"opening", 0},   {"hit 2", 0.5},         {"door", 1},
      {"opening 2", 3}, {"cut", 3 + 10.0 / 24}, {"hit", 5}};
  ASSERT_EQ(markers.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(markers[k].name, expected[k].first);
    EXPECT_NEAR(markers[k].at_s, expected[k].second, 1e-12);
  }
}

TEST(OtioMarkers, RefuseWhatIsNoTimeline) {
  const auto message = [](const std::string& text) { return message_of([&] { read(text); }); };
  const auto clip = [](const std::string& rest) { return timeline("", item("Clip.2", "a", rest)); };
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "no JSON of OpenTimelineIO"},
           {"{\"OTIO_SCHEMA\": \"Clip.2\"}", "it is no OTIO timeline"},
           {timeline(R"({"OTIO_SCHEMA": "Marker.2"})", ""),
            "/tracks/markers/0/marked_range/start_time/rate must be a number"},
           {clip(R"("source_range": null)"), "/tracks/children/0/children/0 has no source_range"},
           {clip(R"("source_range": {"start_time": 0})"), "start_time/rate must be a number"},
           {clip(R"("source_range": {"start_time": )" + time(0) + R"(, "duration": )" + time(1, 0) +
                 "}"),
            "duration/rate must be above 0"},
           {timeline("", item("Stack.1", "nested", R"("children": [])")), "flatten nested tracks"},
           {std::string(100000, '['), "nested too deeply"}})
    EXPECT_NE(message(text).find(words), std::string::npos) << words << ": " << message(text);
}

}  // namespace
}  // namespace domefall
