#include "pipeline/base/lettering.h"

#include <pango/pangocairo.h>

#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

// This is the em in which text is laid out, in Cairo's units.  It is large because Cairo rounds to
// 1/256 of a unit.
constexpr double kEm = 1000;

template <class T>
struct ReleaseObject {
  void operator()(T* object) const { g_object_unref(object); }
};
template <class T>
using GObjectPointer = std::unique_ptr<T, ReleaseObject<T>>;

using AttributesPointer = std::unique_ptr<PangoAttrList, decltype(&pango_attr_list_unref)>;
using FontPointer = std::unique_ptr<PangoFontDescription, decltype(&pango_font_description_free)>;
using CairoPointer = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;
using PathPointer = std::unique_ptr<cairo_path_t, decltype(&cairo_path_destroy)>;

// Returns a context on a surface without bounds, which only gathers paths.
CairoPointer path_gatherer() {
  cairo_surface_t* surface = cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr);
  CairoPointer gatherer(cairo_create(surface), cairo_destroy);
  cairo_surface_destroy(surface);
  return gatherer;
}

void check_cairo(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("Cairo: ") + cairo_status_to_string(status));
}

// Says whether the machine has the family that was asked for.  The words sans, serif and monospace
// are families to Pango.
bool has_family(PangoFontMap* fonts, const PangoFontDescription* font) {
  const char* wanted = pango_font_description_get_family(font);
  if (!wanted) return false;
  PangoFontFamily** families = nullptr;
  int count = 0;
  pango_font_map_list_families(fonts, &families, &count);
  bool found = false;
  for (int k = 0; k < count && !found; ++k)
    found = g_ascii_strcasecmp(pango_font_family_get_name(families[k]), wanted) == 0;
  g_free(families);
  return found;
}

// An OutlineMaker turns Cairo's path, whose y grows downwards, into outlines about `middle`, in
// heights of a capital.
class OutlineMaker {
 public:
  OutlineMaker(TextPoint middle, double capital) : middle_(middle), capital_(capital) {}

  std::vector<TextOutline> outlines(const cairo_path_t& path) {
    for (int k = 0; k < path.num_data; k += path.data[k].header.length) add(path.data + k);
    return std::move(outlines_);
  }

 private:
  TextPoint point(const cairo_path_data_t& data) const {
    return {(data.point.x - middle_.x) / capital_, (middle_.y - data.point.y) / capital_};
  }
  void add(const cairo_path_data_t* part) {
    switch (part->header.type) {
      case CAIRO_PATH_MOVE_TO:
        outlines_.push_back({last_ = point(part[1]), {}});
        break;
      case CAIRO_PATH_LINE_TO:
        add_line(point(part[1]));
        break;
      case CAIRO_PATH_CURVE_TO:
        last_ = point(part[3]);
        outlines_.back().curves.push_back({point(part[1]), point(part[2]), last_, false});
        break;
      case CAIRO_PATH_CLOSE_PATH:
        add_line(outlines_.back().start);
        break;
    }
  }
  void add_line(TextPoint end) {
    const auto at = [&](double part) {
      return TextPoint{last_.x + part * (end.x - last_.x), last_.y + part * (end.y - last_.y)};
    };
    outlines_.back().curves.push_back({at(1. / 3), at(2. / 3), end, true});
    last_ = end;
  }

  TextPoint middle_;
  double capital_;
  TextPoint last_{0, 0};
  std::vector<TextOutline> outlines_;
};

class PangoLettering {
 public:
  // Glyphs are neither hinted nor moved to whole units.  The language is fixed, since that of the
  // environment would have a say in which font is chosen.
  PangoLettering()
      : fonts_(pango_cairo_font_map_new_for_font_type(CAIRO_FONT_TYPE_FT)),
        context_(pango_font_map_create_context(fonts_.get())) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    pango_cairo_context_set_font_options(context_.get(), options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(context_.get(), FALSE);
    pango_context_set_language(context_.get(), pango_language_from_string("en"));
  }

  LetteredText letter(const std::string& text, const LetterStyle& style) const {
    const std::lock_guard lock(one_letters_);
    const FontPointer font(pango_font_description_from_string(style.font.c_str()),
                           pango_font_description_free);
    pango_font_description_set_absolute_size(font.get(), kEm * PANGO_SCALE);
    const double capital = capital_height(font.get());
    if (!(capital > 0))
      throw TemporaryError(
          "no font was found to write with; install one, such as fonts-dejavu-core");
    const GObjectPointer<PangoLayout> layout = laid_out(text, font.get());
    if (style.even_digits) {
      const AttributesPointer attributes(pango_attr_list_new(), pango_attr_list_unref);
      pango_attr_list_insert(attributes.get(), pango_attr_font_features_new("tnum=1"));
      pango_layout_set_attributes(layout.get(), attributes.get());
    }
    constexpr PangoAlignment kAligned[] = {PANGO_ALIGN_LEFT, PANGO_ALIGN_CENTER, PANGO_ALIGN_RIGHT};
    pango_layout_set_alignment(layout.get(), kAligned[static_cast<std::size_t>(style.align)]);

    PangoRectangle logical;
    pango_layout_get_extents(layout.get(), nullptr, &logical);
    const double top = unit(pango_layout_get_baseline(layout.get())) - capital,
                 foot = last_baseline(layout.get());
    LetteredText lettered;
    lettered.half_width = unit(logical.width) / capital / 2;
    lettered.half_height = (foot - top) / capital / 2;
    lettered.em = kEm / capital;
    lettered.font_found = has_family(fonts_.get(), font.get());
    lettered.missing = pango_layout_get_unknown_glyphs_count(layout.get());
    const CairoPointer cairo = path_gatherer();
    pango_cairo_layout_path(cairo.get(), layout.get());
    const PathPointer path(cairo_copy_path(cairo.get()), cairo_path_destroy);
    check_cairo(path->status);
    lettered.outlines =
        OutlineMaker({unit(logical.x) + unit(logical.width) / 2, (top + foot) / 2}, capital)
            .outlines(*path);
    return lettered;
  }

 private:
  static double unit(int pango) { return static_cast<double>(pango) / PANGO_SCALE; }

  GObjectPointer<PangoLayout> laid_out(const std::string& text,
                                       const PangoFontDescription* font) const {
    GObjectPointer<PangoLayout> layout(pango_layout_new(context_.get()));
    char* valid = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
    pango_layout_set_text(layout.get(), valid, -1);
    g_free(valid);
    pango_layout_set_font_description(layout.get(), font);
    return layout;
  }

  double capital_height(const PangoFontDescription* font) const {
    const CairoPointer cairo = path_gatherer();
    pango_cairo_layout_path(cairo.get(), laid_out("H", font).get());
    double left = 0, top = 0, right = 0, bottom = 0;
    cairo_path_extents(cairo.get(), &left, &top, &right, &bottom);
    return bottom - top;
  }

  static double last_baseline(PangoLayout* layout) {
    PangoLayoutIter* line = pango_layout_get_iter(layout);
    while (pango_layout_iter_next_line(line)) {
    }
    const double at = unit(pango_layout_iter_get_baseline(line));
    pango_layout_iter_free(line);
    return at;
  }

  GObjectPointer<PangoFontMap> fonts_;
  GObjectPointer<PangoContext> context_;
  mutable std::mutex one_letters_;
};

}  // namespace

// It stays for good, since fontconfig keeps what it has read of the machine's fonts.
LetteredText lettered(const std::string& text, const LetterStyle& style) {
  static const PangoLettering lettering;
  return lettering.letter(text, style);
}

}  // namespace domefall
