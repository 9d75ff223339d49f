#include "pipeline/theatre/movie/movie_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

using Arguments = std::vector<std::string>;
using TextFile = std::unique_ptr<MemoryFile>;

// Returns a path by which this process, and a child that keeps the descriptor, can open its file,
// whatever name the file has, if any.
std::string path_of_descriptor(int number) { return fmt::format("/proc/self/fd/{}", number); }

// ffmpeg reads subtitles and chapters only from files.
TextFile text_file(const std::string& text) {
  if (text.empty()) return nullptr;
  auto file = std::make_unique<MemoryFile>("the texts of a movie");
  file->append(text);
  return file;
}

// Returns the time code of the first frame, for the rates that SMPTE ST 12-1 counts, which no frame
// is dropped from.  Programs look for one in QuickTime files.
Arguments time_code(const MoviePlan& plan) {
  const auto rate = static_cast<int>(std::ceil(per_second(plan.rate)));
  constexpr std::array kRates{24, 25, 30, 48, 50, 60};
  if (plan.preset.extension != "mov" || std::ranges::find(kRates, rate) == kRates.end()) return {};
  constexpr int kMinute = 60, kHour = 3600, kDay = 24;
  const int seconds = plan.first / rate;
  return {"-timecode",
          fmt::format("{:02}:{:02}:{:02}:{:02}", seconds / kHour % kDay, seconds % kHour / kMinute,
                      seconds % kMinute, plan.first % rate)};
}

Arguments ffmpeg_arguments(const MoviePlan& plan, const TextFile& subtitles,
                           const TextFile& chapters, const Arguments& output) {
  Arguments all{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error", "-y"};
  append(all, input_options(plan.frames, plan.rate));
  append(all, sound_inputs(plan.sound));
  // The file of chapters is the last input.  Without one those of a sound file do not count either.
  if (chapters) append(all, {"-f", "ffmetadata", "-i", "file:" + chapters->path()});
  append(all, {"-map_chapters",
               chapters ? fmt::to_string(1 + plan.sound.files.size()) : std::string("-1")});
  append(all, sound_options(plan.sound, plan.first, plan.count, plan.rate));
  Arguments video = video_options(plan.preset, plan.frames, plan.rate, plan.tags,
                                  subtitles ? subtitles->path() : std::string());
  if (plan.levels) add_light_levels(video, *plan.levels);
  if (plan.mastering) add_mastering_display(video, *plan.mastering);
  append(all, video);
  if (!plan.sound.files.empty()) append(all, plan.preset.sound);
  append(all, output);
  return all;
}

Arguments movie_arguments(const MoviePlan& plan, const TextFile& subtitles,
                          const TextFile& chapters, int file) {
  Arguments output = time_code(plan);
  append(output, {"-metadata", "title=" + plan.title, "-movflags", "+faststart", "-f",
                  std::string(format_of(plan.preset)), "file:" + path_of_descriptor(file)});
  return ffmpeg_arguments(plan, subtitles, chapters, output);
}

constexpr const char *kPackage = "ffmpeg", *kMatroskaPackage = "mkvtoolnix";

// Says whether a program names an error of the disk or of memory.  ffmpeg names it in the words of
// the C library, and does not translate them.
bool names_lack(const ChildOutcome& outcome) {
  const auto says = [&](int error) {
    return outcome.said.find(std::strerror(error)) != std::string::npos;
  };
  return says(ENOSPC) || says(EDQUOT) || says(EIO) || says(EFBIG) || says(ENOMEM) || says(ESTALE);
}

// Has mkvmerge say that a movie is a sphere.  Its options come from a file, as JSON, since it takes
// a word of its command line that begins with @ for the name of such a file, whatever option the
// word belongs to.
//
// Projection type 1 of Matroska is equirectangular.  Matroska's times are whole milliseconds, so
// the exact rate is given beside them.  mkvmerge ends with 1 for warnings and writes what is wrong
// to its standard output. The title stays that of the flat movie.  As an option it could be taken
// for one, such as -o, which mkvmerge looks for before it reads which words belong to which.
ChildOutcome wrap_around(const FrameRate& rate, int from, int to) {
  const nlohmann::json words{"--quiet",
                             "--output",
                             path_of_descriptor(to),
                             "--default-duration",
                             fmt::format("0:{}/{}p", rate.frames, rate.seconds),
                             "--projection-type",
                             "0:1",
                             path_of_descriptor(from)};
  const MemoryFile options("the options of mkvmerge");
  options.append(words.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
  ChildProgram mkvmerge({"mkvmerge", "@" + options.path()}, {from, to, options.number()},
                        kMatroskaPackage);
  ChildOutcome outcome = mkvmerge.wait();
  if (!outcome.good()) outcome.said += mkvmerge.output();
  return outcome;
}

void require_program(const char* name, const char* option, const char* package) {
  const ChildOutcome outcome = ChildProgram({name, option}, {}, package).wait();
  if (!outcome.good())
    throw TemporaryError(
        fmt::format("the program {} does not work here: it {}", name, outcome.text()));
}

std::string codec_of(const Arguments& video) {
  const auto at = std::ranges::find(video, "-c:v");
  return at == video.end() ? std::string("an encoder") : "the encoder " + *(at + 1);
}

ChildOutcome try_small(const MoviePlan& plan) {
  constexpr int kSide = 128;
  MoviePlan small = plan;
  small.frames = {kSide, kSide, plan.frames.pixel_aspect};
  small.first = 0, small.count = 1;
  const TextFile subtitles = text_file(plan.subtitles.substr(0, plan.subtitles.find("Dialogue")));
  const MemoryFile made("a movie on trial"), wrapped("a movie on trial");
  std::vector<int> kept{made.number()};
  if (subtitles) kept.push_back(subtitles->number());
  ChildProgram ffmpeg(movie_arguments(small, subtitles, nullptr, made.number()), kept, kPackage);
  const std::vector<unsigned short> black(std::size_t{3} * kSide * kSide);
  ffmpeg.write(black.data(), black.size() * sizeof black[0]);
  ChildOutcome outcome = ffmpeg.wait();
  if (outcome.good() && plan.preset.whole_sphere)
    outcome = wrap_around(plan.rate, made.number(), wrapped.number());
  return outcome;
}

// Replaces each occurrence of a text in a file by another of the same length, and says whether
// there was one.  Throws as throw_file_error.
bool replace_in(int descriptor, const std::string& from, const std::string& to) {
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  std::string piece(kPiece, '\0');
  bool found = false;
  for (off_t at = 0;;) {
    const ssize_t got = pread(descriptor, piece.data(), piece.size(), at);
    if (got < 0) throw_file_error(path_of_descriptor(descriptor), errno);
    const std::string_view read(piece.data(), static_cast<std::size_t>(got));
    for (std::size_t k = 0; (k = read.find(from, k)) != std::string_view::npos; k += from.size()) {
      found = true;
      if (pwrite(descriptor, to.data(), to.size(), at + static_cast<off_t>(k)) !=
          static_cast<ssize_t>(to.size()))
        throw_file_error(path_of_descriptor(descriptor), errno);
    }
    if (read.size() < from.size()) return found;
    // The last bytes may be the beginning of another one.
    at += static_cast<off_t>(read.size() - (from.size() - 1));
  }
}

}  // namespace

void try_movie(const MoviePlan& plan) {
  for (const char* program : {"ffmpeg", "ffprobe"}) require_program(program, "-version", kPackage);
  if (plan.preset.whole_sphere) require_program("mkvmerge", "--version", kMatroskaPackage);
  const ChildOutcome outcome = try_small(plan);
  if (outcome.good()) return;
  if (!plan.sound.files.empty() && !outcome.killed() && !names_lack(outcome)) {
    MoviePlan silent = plan;
    silent.sound = {};
    if (try_small(silent).good())
      throw InputError(
          fmt::format("{}: this cannot be the sound of the preset {}{}; ffmpeg {}",
                      plan.sound.files.front().file.string(), plan.preset.name,
                      plan.sound.layout.empty()
                          ? ""
                          : "; its codec may have no place for the channels " + plan.sound.layout,
                      outcome.text()));
  }
  throw TemporaryError(fmt::format(
      "the programs of this machine cannot make the preset {}, which needs {}{} of ffmpeg; some "
      "builds leave them out for their licences, and Debian's package ffmpeg has them; a trial {}",
      plan.preset.name, codec_of(plan.preset.video),
      plan.preset.burn_in ? " and the filters zscale and ass" : " and the filter zscale",
      outcome.text()));
}

MovieFile::MovieFile(const std::filesystem::path& path, const MoviePlan& plan)
    : path_(path),
      count_(plan.count),
      rate_(plan.rate),
      file_(path),
      subtitles_(text_file(plan.subtitles)),
      chapters_(text_file(plan.chapters)) {
  if (plan.preset.whole_sphere) flat_.emplace(path);
  std::vector<int> kept{by_ffmpeg()};
  for (const TextFile* text : {&subtitles_, &chapters_})
    if (*text) kept.push_back((*text)->number());
  ffmpeg_ = std::make_unique<ChildProgram>(
      movie_arguments(plan, subtitles_, chapters_, by_ffmpeg()), kept, kPackage);
}

void MovieFile::add(const RowPicture& frame) {
  using Strip = std::vector<unsigned short>;
  const int most = rows_of_strip(frame.width, frame.height);
  const auto row = static_cast<std::size_t>(frame.width) * 3;
  const auto rows_in = [&](int part) { return std::min(most, frame.height - part * most); };
  bool reads = true;
  make_in_order<Strip>((frame.height + most - 1) / most,
                       [&](int part, Strip& strip) {
                         strip.resize(row * static_cast<std::size_t>(most));
                         frame.rows(part * most, part * most + rows_in(part), strip.data());
                       },
                       [&](int part, Strip& strip) {
                         const std::size_t values = row * static_cast<std::size_t>(rows_in(part));
                         reads = reads && ffmpeg_->write(strip.data(), values * sizeof strip[0]);
                       });
  if (!reads) fail(ffmpeg_->wait());
  ++added_;
}

void MovieFile::finish(const std::optional<LightLevels>& levels) {
  const ChildOutcome outcome = ffmpeg_->wait();
  // After a write that failed for a full disk ffmpeg may end with 0.
  if (!outcome.good() || names_lack(outcome)) fail(outcome);
  if (levels) put_levels(*levels);
  if (flat_) {
    const ChildOutcome wrapped = wrap_around(rate_, flat_->descriptor(), file_.descriptor());
    const std::string what = fmt::format("{}: mkvmerge, which says that it is a sphere, {}",
                                         path_.string(), wrapped.text());
    if (wrapped.killed() || names_lack(wrapped)) throw TemporaryError(what);
    if (!wrapped.good()) throw std::runtime_error(what);
  }
  count_frames(outcome);
  if (fsync(file_.descriptor()) != 0) throw_file_error(path_, errno);
  file_.put_in_place();
}

void MovieFile::put_levels(const LightLevels& levels) const {
  const auto to_come = in_hevc(kLevelsToCome), known = in_hevc(levels);
  replace_in(by_ffmpeg(), to_come[1], known[1]);
  if (!replace_in(by_ffmpeg(), to_come[0], known[0]))
    throw std::runtime_error(path_.string() + ": the encoder left no place for the light levels");
}

// Matroska says nothing of its number of frames, so that those of a sphere are counted.
void MovieFile::count_frames(const ChildOutcome& made) const {
  const bool is_told = !flat_;
  Arguments command{"ffprobe", "-v", "error", "-select_streams", "v:0"};
  append(command, is_told ? Arguments{"-show_entries", "stream=nb_frames"}
                          : Arguments{"-count_packets", "-show_entries", "stream=nb_read_packets"});
  append(command, {"-of", "default=noprint_wrappers=1:nokey=1", "-i",
                   "file:" + path_of_descriptor(file_.descriptor())});
  ChildProgram probe(std::move(command), {file_.descriptor()}, kPackage);
  const ChildOutcome outcome = probe.wait();
  std::string found = probe.output();
  found.resize(std::min(found.size(), found.find('\n')));
  if (!outcome.good() || found != fmt::to_string(count_))
    throw TemporaryError(fmt::format(
        "{}: ffmpeg was given {} frames, and the movie that it wrote has {}; nothing was kept{}",
        path_.string(), count_, found.empty() ? "none that can be read" : found,
        made.said.empty() ? "" : ":\n" + made.said));
}

void MovieFile::fail(const ChildOutcome& outcome) const {
  const std::string what = fmt::format("{}: after {} of {} frames ffmpeg {}", path_.string(),
                                       added_, count_, outcome.text());
  // ffmpeg catches a signal, says that it has received it, and ends with a code.
  const bool ended = outcome.killed() || outcome.said.find("received signal") != std::string::npos;
  if (ended || names_lack(outcome)) throw TemporaryError(what);
  throw std::runtime_error(what);
}

// ---- the preview's sound ----

namespace {

// Returns the filter by which a sound becomes stereo.  ffmpeg knows what to do with channels that
// have names.  Of others, such as the speakers of a dome by their numbers, both ears hear the mean.
std::string to_stereo(const Sound& sound) {
  constexpr int kMostGuessed = 8;  // channels of one file, for which ffmpeg has names
  const bool named =
      sound.files.size() == 1 ? sound.channels <= kMostGuessed : !sound.layout.empty();
  if (named) return "aformat=channel_layouts=stereo";
  std::string mean;
  for (int k = 0; k < sound.channels; ++k)
    mean += fmt::format("{}{:.6f}*c{}", k > 0 ? "+" : "", 1.0 / sound.channels, k);
  return fmt::format("pan=stereo|c0={}|c1={}", mean, mean);
}

}  // namespace

std::string sound_for_browser(const Show& show) {
  if (show.audio.empty()) throw InputError("the show names no audio");
  const Sound sound = show_sound(show, {});
  const std::string filter =
      sound_filter(sound, 0, 0, frame_count(show), frame_rate_of(show.frames_per_second)) +
      ";[sound]" + to_stereo(sound) + "[stereo]";
  const MemoryFile made("the sound of the preview");
  Arguments all{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error", "-y"};
  append(all, sound_inputs(sound));
  append(all, {"-filter_complex", filter, "-map", "[stereo]", "-c:a", "aac", "-b:a", "160k",
               "-movflags", "+faststart", "-f", "mp4", "file:" + made.path()});
  const ChildOutcome outcome = ChildProgram(all, {made.number()}, kPackage).wait();
  if (!outcome.good())
    throw TemporaryError("the sound cannot be heard here: ffmpeg " + outcome.text());
  return made.contents();
}

}  // namespace domefall
