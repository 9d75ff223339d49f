// What the files of a 4k frame cost, stage by stage, in CPU time of one thread, and what the
// encoders cost that they have replaced: OpenEXR with zlib, OpenImageIO's PNG and TIFF.  The frame
// is the first of shows/last_stable_orbit.yaml, or the scene-linear file that DOMEFALL_FRAME names.
// Files are flushed to the disk as in a run.
//
//     build/release/tests/bench_files
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "pipeline/base/deflate.h"
#include "pipeline/base/stop_watch.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/exr_writer.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/file/read_show.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

struct Sample {
  Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  HalfFrame frame;
  std::optional<Grader> grader;
  GradedFrame graded;

  Sample() {
    const char* file = std::getenv("DOMEFALL_FRAME");
    frame = file ? read_frame(file).first : Renderer(show, 0).render(frame_state(show, 0));
    grader.emplace(show.grade);
    graded = grader->grade(frame);  // which makes the table
  }
};

const Sample& sample() {
  static const Sample made;
  return made;
}

// Measures write(path), which makes a file.
template <class Write>
void measure_file(benchmark::State& state, const char* name, Write write) {
  sample();
  const fs::path path = fs::temp_directory_path() / (std::string("domefall_bench_") + name);
  const double start = processor_seconds();
  for (auto _ : state) write(path);
  state.counters["cpu_ms"] =
      1e3 * (processor_seconds() - start) / static_cast<double>(state.iterations());
  state.counters["MB"] = 1e-6 * static_cast<double>(fs::file_size(path));
  fs::remove(path);
}

// As new files are.
void flush(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY);
  fsync(file);
  close(file);
}

void former_exr(benchmark::State& state) {
  measure_file(state, "a.exr", [](const fs::path& path) {
    const HalfFrame& frame = sample().frame;
    Imf::Header header(frame.width, frame.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = 2;
    Imf::FrameBuffer buffer;
    auto* base = reinterpret_cast<char*>(const_cast<Imath::half*>(frame.pixels.data()));
    const std::size_t pixel = 3 * sizeof(Imath::half);
    std::size_t at = 0;
    for (const char* name : {"R", "G", "B"}) {
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      buffer.insert(name, Imf::Slice(Imf::HALF, base + at, pixel,
                                     pixel * static_cast<std::size_t>(frame.width)));
      at += sizeof(Imath::half);
    }
    {
      Imf::OutputFile file(path.c_str(), header, 0);
      file.setFrameBuffer(buffer);
      file.writePixels(frame.height);
    }
    flush(path);
  });
}

void former_picture(benchmark::State& state, const char* name) {
  measure_file(state, name, [](const fs::path& path) {
    const GradedFrame& graded = sample().graded;
    OIIO::attribute("threads", 1);
    OIIO::ImageSpec spec(graded.width, graded.height, 3, OIIO::TypeDesc::UINT16);
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("png:filter", 16);
    spec.attribute("compression", "zip");
    spec.attribute("tiff:zipquality", 1);
    const auto out = OIIO::ImageOutput::create(path.string());
    if (!out || !out->open(path.string(), spec) ||
        !out->write_image(OIIO::TypeDesc::UINT16, graded.pixels.data()) || !out->close())
      throw std::runtime_error("OpenImageIO could not write " + path.string());
    flush(path);
  });
}

void exr(benchmark::State& state, ExrCompression compression) {
  measure_file(state, "b.exr",
               [&](const fs::path& path) { write_frame(path, sample().frame, {}, compression); });
}

void picture(benchmark::State& state, GradedKind kind) {
  measure_file(state, extension_of(kind),
               [&](const fs::path& path) { write_graded(path, sample().graded, {}, {kind}); });
}

// The stages within: what a strip or a block goes through.
void grade(benchmark::State& state) {
  GradedFrame out(sample().frame.width, sample().frame.height);
  for (auto _ : state) sample().grader->grade_rows(sample().frame, 0, out.height, out.row(0));
}

void dither(benchmark::State& state) {
  const GradedFrame& graded = sample().graded;
  std::vector<std::uint8_t> out(graded.pixels.size());
  for (auto _ : state) dither_rows(graded.row(0), graded.width, graded.height, 0, 7, out.data());
}

void deflate(benchmark::State& state) {
  const GradedFrame& graded = sample().graded;
  constexpr std::size_t kStrip = 1 << 19;
  const std::string_view bytes(reinterpret_cast<const char*>(graded.pixels.data()),
                               2 * graded.pixels.size());
  Deflater deflater;
  ByteBlock out;
  for (auto _ : state)
    for (std::size_t at = 0; at < bytes.size(); at += kStrip)
      deflater.pack_part(bytes.substr(at, kStrip), out);
}

BENCHMARK(grade)->Unit(benchmark::kMillisecond);
BENCHMARK(dither)->Unit(benchmark::kMillisecond);
BENCHMARK(deflate)->Unit(benchmark::kMillisecond);
BENCHMARK(former_exr)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exr, zip, ExrCompression::kZip)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exr, zips, ExrCompression::kZips)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exr, piz, ExrCompression::kPiz)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exr, none, ExrCompression::kNone)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(former_picture, png16, "a.png")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, png16, GradedKind::kPng16)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, png8, GradedKind::kPng8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, jpeg, GradedKind::kJpeg)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(former_picture, tiff16, "a.tif")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, tiff16, GradedKind::kTiff16)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(picture, tiff8, GradedKind::kTiff8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace domefall
