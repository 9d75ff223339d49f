#include "pipeline/program/cli/verb_notes.h"

namespace domefall {
namespace {

// First what is said of the program itself.
const std::vector<VerbNotes> kNotes{
    {"",
     "A show is a YAML file with a timeline: where the observer is, how the camera looks\n"
     "and what the sky is. A frame depends on that file, its assets and the frame's\n"
     "number alone, so that any machine makes any frame, and a run that was stopped\n"
     "goes on when it is started again.\n"
     "\n"
     "What is printed on standard output is data; all talk goes to standard error.",
     {{"domefall check fall.yaml", "finds every mistake, and says what the show does"},
      {"domefall preview fall.yaml", "opens a viewer that follows the file as it is edited"},
      {"domefall render fall.yaml --size 4k", "renders all frames to out/fall"}},
     "show-format.md"},

    // These verbs lead from a show's file to its frames.
    {"check",
     "Reads the show and all that it names, and prints the observer's path, the light\n"
     "in the frames, the time that they will take, the room on the disk, and warnings\n"
     "of jumps and of light that a dome cannot show.",
     {{"domefall check fall.yaml --json | jq .warnings", "the warnings alone, for a program"}},
     "show-format.md"},
    {"render",
     "Frames go to linear/ (EXR, half floats, ACEScg) and graded/ below the folder\n"
     "--out. Good frames that are there already are kept, and all others are made; a\n"
     "frame gets its name when it is whole. Frames of another show, size or kind are\n"
     "replaced only with --replace.",
     {{"domefall render fall.yaml --frames 0-599x10 --size 1k", "every tenth frame, small"},
      {"domefall render fall.yaml --frames 0-99 --size 4k --out /farm/fall",
       "a farm's node makes its share"},
      {"domefall render fall.yaml --frames 0 --lens-map", "a map to lens other pictures by"}},
     "farm.md"},
    {"grade",
     "Takes the light from linear/ and writes graded/ anew, by the grade of the show as\n"
     "it is now. Nothing is rendered.",
     {{"domefall grade fall.yaml --out /farm/fall", "after an edit of the show's grade"}},
     "grading.md"},
    {"preview",
     "Serves a viewer to this machine alone (127.0.0.1), opens it in the browser, and\n"
     "shows every save of the file at once. The address, and below it a line for an\n"
     "ssh tunnel, are printed; Ctrl-C ends it. With --out one frame is rendered as a\n"
     "flat picture instead.",
     {{"domefall preview fall.yaml --no-open", "on a machine without a screen"},
      {"domefall preview fall.yaml --at 0:34 --out still.png", "one picture for a screen"}},
     "preview.md"},

    // These verbs lead from finished frames to the audience.
    {"movie",
     "Frames are rendered and handed to ffmpeg through a pipe, or taken from the folder\n"
     "--from. The preset review burns numbers in, but adds none to frames that have\n"
     "them by --overlay burn_in; vr360 needs mkvmerge, too.\n"
     "\n"
     "--audio takes all that follows it, so the show stands before it.",
     {{"domefall movie fall.yaml --preset review", "to look at and to talk about"},
      {"domefall movie fall.yaml --preset dome --from out/fall --audio mix.wav",
       "finished frames with sound"}},
     "movies.md"},
    {"deliver",
     "Makes a folder of finished graded frames with readme, metadata, alignment frame,\n"
     "contact sheet and SHA-256 sums, or compares one with its sums.",
     {{"domefall deliver fall.yaml --from out/fall --out fall_4k --depth 8 --leader",
       "what most festivals ask for"},
      {"domefall deliver --check fall_4k", "was it copied whole?"}},
     "delivery.md"},
    {"timeline",
     "Writes what editing programs read: a clip for each segment, with dissolves,\n"
     "markers and the frames that they refer to; the markers alone; or the titles.\n"
     "A show takes markers from such a file, too.",
     {{"domefall timeline fall.yaml --from out/fall --out fall.otio", "to cut and to mark"},
      {"domefall timeline fall.yaml --format vtt --out fall.vtt", "titles for a web player"}},
     "timeline.md"},
    {"sheet",
     "Puts up to 36 frames of the show on one picture, with their numbers.",
     {{"domefall sheet fall.yaml --from out/fall --out sheet.jpg", "of frames in out/fall"}},
     "delivery.md"},

    // By these verbs many processes make one show.
    {"farm",
     "A show is divided into tasks, which render what is missing; what was made is\n"
     "verified, and what is bad is made again. All of it can be run again at any time.",
     {},
     "farm.md"},
    {"farm submit",
     "Checks the show, plans tasks of equal time, and hands them to the engine. With\n"
     "slurm and local, the frames are verified when all tasks have ended, and what\n"
     "is missing is rendered again, for as many rounds as --rounds allows.",
     {{"domefall farm submit fall.yaml --engine local --out out/fall", "processes on this machine"},
      {"domefall farm submit fall.yaml --engine slurm --out /farm/fall --size 4k --dry-run",
       "what would be given to Slurm"}},
     "farm.md"},
    {"farm status",
     "Goes by the names of files, their beginnings and what their writers noted, and\n"
     "reads no pixels. Says what a changed show invalidates, who makes what, and how\n"
     "long the rest will take.",
     {{"domefall farm status /farm/fall --watch", "until all frames are done"}},
     "farm_status.md"},
    {"farm verify",
     "Reads every byte. Ends with 0 where all frames are there and good, and no other\n"
     "file is among them; with --repair whatever other files are. Ends with 1 where\n"
     "something is missing or wrong, and with 75 where something cannot be read.",
     {{"domefall farm verify /farm/fall --repair", "and make again what is not good"},
      {"domefall farm verify out/fall --show fall.yaml --json", "of a folder without a plan"}},
     "farm_status.md"},
    {"farm work",
     "Jobs call it; it needs a plan that farm submit has made.",
     {{"domefall farm work /farm/fall --plan ID --task 3", "the fourth task of the first round"}},
     "farm.md"},
    {"farm conclude",
     "Jobs call it when the tasks of a round have ended.",
     {{"domefall farm conclude /farm/fall --plan ID", "after the first round"}},
     "farm.md"},

    // These verbs answer with numbers.
    {"states",
     "Prints region, radius, proper time, velocity and camera axes of each frame; r and\n"
     "proper times in units of M.",
     {{"domefall states fall.yaml --frames 0-99", "100 rows, with what the columns mean"},
      {"domefall states fall.yaml --plot fall.svg >fall.csv", "and the path as a drawing"}},
     "show-format.md"},
    {"probe",
     "Traces the ray of one pixel and tells where its light comes from, how it was\n"
     "shifted and amplified, and which stars and bodies have an image there.",
     {{"domefall probe fall.yaml --at 0:10 --pixel 512,300", "at 10 s, 300 rows from the top"}},
     "show-format.md"},
    {"trace",
     "Each row of the table is a ray: who sees it, at which r, at which angle delta\n"
     "from the direction of the hole. The answer has as many rows: where the\n"
     "light comes from, how far it was bent, its shift and amplification. With a\n"
     "column psi, r_there is the ray's r after sweeping that angle, followed back\n"
     "in time, and null_time the place's time v less the observer's (u for outgoing\n"
     "and T_IV; M), where v = t + r + 2 ln|r/2 - 1| and u = t - r - 2 ln|r/2 - 1|.\n"
     "Both are empty where the ray has ended.\n"
     "Near a charge (q = charge M, above 1 a naked singularity) the observer moves as\n"
     "the tetrad T of l + n/2, which is regular on the horizons that it falls through;\n"
     "theta is his place and eta the light's direction about -R, from Theta to Phi.\n"
     "The answer is the origin (I, III, H for the past horizon, B for nowhere; beyond,\n"
     "for H: E for an earlier universe's sky), the place on that sky, shift,\n"
     "amplification, turns in theta, and Mino's time, by the exact integral, which\n"
     "`domefall report` compares with charts and integrators.\n"
     "Edges there are silhouette, inner and region3.\n"
     "In a wormhole (profile ellis or dngr; its radius rho, half length a, m of its\n"
     "lensing width and the place l in one unit; edge throat) the observer is at rest,\n"
     "and the origin own or other, by the side of the throat.",
     {{"domefall trace --table rays.csv --method exact >traced.csv", "by elliptic integrals"}},
     "accuracy.md"},
    {"report",
     "Measures errors and times on this machine and writes pages about them. It takes\n"
     "some minutes, and calls gnuplot.",
     {{"domefall report --out report --quick", "in seconds, with fewer rays"}},
     "accuracy.md"},

    // These verbs are about what is in the sky.
    {"stars", "Star catalogues are .stars files, which a show names.", {}, "stars.md"},
    {"stars import",
     "A file appears whole or not at all.",
     {{"domefall stars import auto hygdata_v41.csv --out hyg.stars", "the format by the file"}},
     "stars.md"},
    {"stars info",
     "Prints how many stars there are, how bright, from where, and under which licence.",
     {{"domefall stars info hyg.stars", "on one page"}},
     "stars.md"},
    {"sky", "Maps of the whole sky are .sky files, which a show names.", {}, "skies.md"},
    {"sky import",
     "Takes panoramas, and HEALPix maps in FITS. The result is compared with stars and\n"
     "Milky Way, and a map that seems to lie otherwise on the sky is warned of.\n"
     "Defaults that depend on the picture stand in brackets.",
     {{"domefall sky import panorama.exr --frame galactic --out panorama.sky",
       "a picture with the galactic centre in its middle"}},
     "skies.md"},
    {"sky build",
     "Spreads the light of stars that are too faint to be drawn one by one.",
     {{"domefall sky build --stars tycho2.stars --out starlight.sky", "of 2.4 million stars"}},
     "skies.md"},
    {"sky check",
     "Exits with 2 where the map seems to be mirrored, turned or upside down.",
     {{"domefall sky check panorama.sky", "how well each place fits"}},
     "skies.md"},
    {"sky info",
     "Prints kind, size, source and licence.",
     {{"domefall sky info panorama.sky --verify", "and compares every checksum"}},
     "skies.md"},
};

// A name and what it means.
using Meaning = std::pair<std::string_view, std::string_view>;

constexpr Meaning kExitCodes[] = {
    {"0", "It is done."},
    {"2", "The input is wrong: a command, a show, a file. Trying again is useless."},
    {"75", "It is worth trying again, here or elsewhere: a full disk, a missing asset."},
    {"128 + n", "Signal n has stopped it; the same command goes on."},
    {"1", "Anything else; please report it."}};

constexpr Meaning kVariables[] = {
    {"DOMEFALL_ASSETS",
     "The folder of sky maps, catalogues and the colour configuration, in the place of "
     "share/domefall/assets beside the program's bin."},
    {"DOMEFALL_SIMD",
     "The instructions that are used at most: portable, avx2 or avx512. Frames are the same by "
     "each."},
    {"OCIO",
     "Is not read, since frames depend on the show alone: grade: {config: FILE} in the show names "
     "an OpenColorIO configuration."}};

std::string indented(std::string_view name, std::string_view meaning) {
  return std::string("  ").append(name).append("\n      ").append(meaning).append("\n");
}

}  // namespace

const std::vector<VerbNotes>& all_verb_notes() { return kNotes; }

std::string help_footer(const VerbNotes& notes) {
  std::string text = std::string(notes.about) + "\n";
  if (!notes.examples.empty()) text += "\nExamples:\n";
  for (const auto& [command, what] : notes.examples) text += indented(command, what);
  if (!notes.document.empty())
    text += std::string("\nMore in docs/").append(notes.document).append(".\n");
  if (notes.verb.empty()) {
    text += "\nExit codes:\n";
    for (const auto& [code, meaning] : kExitCodes) text += indented(code, meaning);
    text += "\nEnvironment:\n";
    for (const auto& [name, meaning] : kVariables) text += indented(name, meaning);
  }
  text.pop_back();
  return text;
}

}  // namespace domefall
