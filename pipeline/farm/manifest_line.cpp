#include <nlohmann/json.hpp>

#include "pipeline/farm/manifest.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const Json& json) {
  // A file's name need not be UTF-8.  A name that is not is not found again, and its file is read.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

MadeFile made_of(const nlohmann::json& json) {
  MadeFile made;
  made.frame = json.at("frame").get<int>();
  made.file = json.at("file").get<std::string>();
  made.size = json.at("size").get<std::uint64_t>();
  made.mtime_ns = json.at("mtime_ns").get<std::int64_t>();
  made.digest = json.at("digest").get<std::string>();
  made.key = json.at("key").get<std::string>();
  made.seconds = json.at("seconds").get<double>();
  made.brightest = json.at("brightest").get<double>();
  made.host = json.at("host").get<std::string>();
  made.pid = json.at("pid").get<pid_t>();
  return made;
}

}  // namespace

std::string text_of(const MadeFile& made) {
  return line_of({{"frame", made.frame},
                  {"file", made.file},
                  {"size", made.size},
                  {"digest", made.digest},
                  {"mtime_ns", made.mtime_ns},
                  {"key", made.key},
                  {"seconds", made.seconds},
                  {"brightest", made.brightest},
                  {"host", made.host},
                  {"pid", made.pid}});
}

std::string text_of(const BegunFrame& begun) {
  return line_of({{"frame", begun.frame},
                  {"begun_s", begun.since_s},
                  {"host", begun.host},
                  {"pid", begun.pid}});
}

std::optional<ManifestLine> parse_manifest_line(std::string_view line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  try {
    ManifestLine parsed;
    if (json.contains("begun_s"))
      parsed.begun = BegunFrame{json.at("frame").get<int>(), json.at("begun_s").get<double>(),
                                json.at("host").get<std::string>(), json.at("pid").get<pid_t>()};
    else
      parsed.made = made_of(json);
    return parsed;
  } catch (const nlohmann::json::exception&) {  // torn, or of another kind
    return std::nullopt;
  }
}

}  // namespace domefall
