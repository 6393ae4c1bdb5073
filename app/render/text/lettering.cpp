#include "app/render/text/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_GLYPH_H
#include FT_STROKER_H

#include <algorithm>
#include <cmath>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

using Eigen::Vector2d;

constexpr std::array<const char*, 2> kFontFiles = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};
constexpr double kHaloShare = 0.05;  // of the size of the letters: width of the halo beyond 1 px
constexpr float kHaloCover = 0.72f;
constexpr char32_t kReplacement = 0xFFFD;

// UTF-8 to code points (RFC 3629; overlong forms are accepted).
std::vector<char32_t> code_points(const std::string& text) {
  std::vector<char32_t> points;
  std::size_t i = 0;
  while (i < text.size()) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80 ? 0 : first >> 5 == 0x6 ? 1 : first >> 4 == 0xE ? 2 : 3;
    if (first >= 0x80 && (first < 0xC0 || first >= 0xF8)) {
      points.push_back(kReplacement);
      continue;
    }
    char32_t point = more == 0 ? first : first & (0x3Fu >> more);
    int read = 0;
    for (; read < more && i < text.size(); ++read, ++i) {
      const auto next = static_cast<unsigned char>(text[i]);
      if (next >> 6 != 0x2) break;
      point = (point << 6) | (next & 0x3Fu);
    }
    points.push_back(read == more ? point : kReplacement);
  }
  return points;
}

FT_F26Dot6 to_26_6(double px) {
  return static_cast<FT_F26Dot6>(std::lround(64 * px));
}

// Light letters get a dark halo and dark ones a light halo.
Color halo_of(const Color& c) {
  const float luminance = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  return luminance < 0.55f ? Color{0.97f, 0.98f, 0.99f, c.a} : Color{0.06f, 0.07f, 0.09f, c.a};
}

// Ignores pixels outside the picture.
void blend(Image& image, int x, int y, const Color& color, float cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* pixel = image.pixel(x, y);
  const float a = std::clamp(cover * color.a, 0.0f, 1.0f);
  const std::array<float, 3> over = {color.r, color.g, color.b};
  for (std::size_t k = 0; k < 3; ++k) {
    const float mixed = (1 - a) * static_cast<float>(pixel[k]) + a * 255.0f * over[k];
    pixel[k] = static_cast<std::uint8_t>(std::clamp(mixed + 0.5f, 0.0f, 255.0f));
  }
}

void blend_bitmap(Image& image, FT_BitmapGlyph glyph, int x, int y, const Color& color,
                  float strength) {
  const FT_Bitmap& bitmap = glyph->bitmap;
  for (unsigned row = 0; row < bitmap.rows; ++row) {
    const unsigned char* line = bitmap.buffer + static_cast<int>(row) * bitmap.pitch;
    for (unsigned column = 0; column < bitmap.width; ++column) {
      if (line[column] == 0) continue;
      blend(image, x + glyph->left + static_cast<int>(column),
            y - glyph->top + static_cast<int>(row), color,
            strength * static_cast<float>(line[column]) / 255.0f);
    }
  }
}

// Blends a shape, given by its signed distance (positive inside), over the pixels of a box.
template <class Inside>
void fill(Image& image, const Vector2d& low, const Vector2d& high, const Color& color,
          Inside&& inside) {
  const int x0 = static_cast<int>(std::floor(std::max(0.0, low.x() - 1)));
  const int y0 = static_cast<int>(std::floor(std::max(0.0, low.y() - 1)));
  const int x1 = static_cast<int>(std::ceil(std::min<double>(image.width, high.x() + 1)));
  const int y1 = static_cast<int>(std::ceil(std::min<double>(image.height, high.y() + 1)));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double distance = inside(Vector2d(x + 0.5, y + 0.5));
      const auto cover = static_cast<float>(std::clamp(distance + 0.5, 0.0, 1.0));
      if (cover > 0) blend(image, x, y, color, cover);
    }
  }
}

}  // namespace

class Lettering::Impl {
 public:
  Impl() {
    if (FT_Init_FreeType(&library_) != 0) fail("FreeType", "cannot be initialised", "free memory");
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (FT_New_Face(library_, kFontFiles[i], 0, &faces_[i]) != 0) {
        FT_Done_FreeType(library_);
        fail(kFontFiles[i], "font cannot be read", "install fonts-dejavu-core");
      }
    }
    if (FT_Stroker_New(library_, &stroker_) != 0) {
      FT_Done_FreeType(library_);
      fail("FreeType", "cannot create a stroker", "free memory");
    }
  }
  ~Impl() {
    FT_Stroker_Done(stroker_);
    FT_Done_FreeType(library_);  // with its faces
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  double width(const std::string& text, double size_px, Weight weight) {
    FT_Face face = sized_face(size_px, weight);
    double x = 0;
    for (const char32_t point : code_points(text)) {
      if (load(face, point)) x += advance(face);
    }
    return x;
  }

  void draw(Image& image, const std::string& text, const Eigen::Vector2d& start_px, double size_px,
            const Color& color, Weight weight) {
    FT_Face face = sized_face(size_px, weight);
    FT_Stroker_Set(stroker_, to_26_6(1 + kHaloShare * size_px), FT_STROKER_LINECAP_ROUND,
                   FT_STROKER_LINEJOIN_ROUND, 0);
    // All halos before all letters.
    for (const bool halo : {true, false}) {
      double x = start_px.x();
      for (const char32_t point : code_points(text)) {
        if (!load(face, point)) continue;
        draw_glyph(image, face, {x, start_px.y()}, halo ? halo_of(color) : color, halo);
        x += advance(face);
      }
    }
  }

 private:
  [[noreturn]] static void fail(const std::string& file, const std::string& problem,
                                const std::string& fix) {
    throw InputError({Diagnostic{file, 0, "lettering", problem, fix, "render.lettering"}});
  }

  FT_Face sized_face(double size_px, Weight weight) {
    FT_Face face = faces_[weight == Weight::bold ? 1 : 0];
    FT_Set_Char_Size(face, 0, to_26_6(std::clamp(size_px, 4.0, 400.0)), 72, 72);
    return face;
  }

  // Light hinting: vertical only, so that the spacing is exact.
  static bool load(FT_Face face, char32_t point) {
    return FT_Load_Char(face, static_cast<FT_ULong>(point),
                        FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT) == 0;
  }
  static double advance(FT_Face face) {
    return static_cast<double>(face->glyph->linearHoriAdvance) / 65536.0;
  }

  void draw_glyph(Image& image, FT_Face face, const Eigen::Vector2d& at_px, const Color& color,
                  bool halo) {
    FT_Glyph glyph = nullptr;
    if (FT_Get_Glyph(face->glyph, &glyph) != 0) return;
    if (halo) FT_Glyph_Stroke(&glyph, stroker_, 1);
    // Whole pixels by the bitmap's position, the fraction of x by the outline's.
    const double column = std::floor(at_px.x()), row = std::round(at_px.y());
    FT_Vector remainder{to_26_6(at_px.x() - column), 0};
    if (FT_Glyph_To_Bitmap(&glyph, FT_RENDER_MODE_NORMAL, &remainder, 1) == 0)
      blend_bitmap(image, reinterpret_cast<FT_BitmapGlyph>(glyph), static_cast<int>(column),
                   static_cast<int>(row), color, halo ? kHaloCover : 1.0f);
    FT_Done_Glyph(glyph);
  }

  FT_Library library_ = nullptr;
  FT_Stroker stroker_ = nullptr;
  std::array<FT_Face, kFontFiles.size()> faces_{};
};

Lettering::Lettering() : impl_(std::make_unique<Impl>()) {}
Lettering::~Lettering() = default;

double Lettering::width(const std::string& text, double size_px, Weight weight) {
  return impl_->width(text, size_px, weight);
}

void Lettering::draw(Image& image, const std::string& text, const Eigen::Vector2d& start_px,
                     double size_px, const Color& color, Weight weight) {
  if (start_px.allFinite()) impl_->draw(image, text, start_px, size_px, color, weight);
}

void draw_box(Image& image, const Vector2d& low, const Vector2d& high, double radius,
              const Color& color) {
  const Vector2d center = 0.5 * (low + high), half = 0.5 * (high - low);
  fill(image, low, high, color, [&](const Vector2d& p) {
    const Vector2d out = (p - center).cwiseAbs() - half + Vector2d::Constant(radius);
    return radius - out.cwiseMax(0).norm() - std::min(0.0, out.maxCoeff());
  });
}

void draw_line(Image& image, const Vector2d& a, const Vector2d& b, double width,
               const Color& color) {
  const Vector2d ab = b - a;
  const double squared = ab.squaredNorm();
  if (!(squared > 0)) return;
  const Vector2d margin = Vector2d::Constant(width);
  fill(image, a.cwiseMin(b) - margin, a.cwiseMax(b) + margin, color, [&](const Vector2d& p) {
    const double t = std::clamp((p - a).dot(ab) / squared, 0.0, 1.0);
    return 0.5 * width - (p - a - t * ab).norm();
  });
}

void draw_dot(Image& image, const Vector2d& center, double radius, const Color& color) {
  const Vector2d reach = Vector2d::Constant(radius);
  fill(image, center - reach, center + reach, color,
       [&](const Vector2d& p) { return radius - (p - center).norm(); });
}

}  // namespace twinarm
