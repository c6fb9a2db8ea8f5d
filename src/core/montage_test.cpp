#include "core/montage.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/bitmap_font.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

Image filled(int width, int height, float value) {
  Image image(width, height);
  std::ranges::fill(image.pixels, value);
  return image;
}

float sum(const Image& image) {
  float total = 0;
  for (const float v : image.pixels) total += v;
  return total;
}

TEST(Montage, PutsTilesIntoRowsInReadingOrder) {
  const Image m = make_montage({{filled(3, 2, 0.1f), ""}, {filled(3, 2, 0.2f), ""}, {filled(3, 2, 0.3f), ""}}, 2);
  ASSERT_EQ(m.width, 6);
  ASSERT_EQ(m.height, 4);
  EXPECT_EQ(m.at(0, 0)[0], 0.1f);
  EXPECT_EQ(m.at(2, 1)[2], 0.1f);
  EXPECT_EQ(m.at(3, 0)[0], 0.2f);
  EXPECT_EQ(m.at(0, 2)[1], 0.3f);
  EXPECT_EQ(m.at(3, 2)[0], 0.0f);  // nothing in the last place
}

TEST(Montage, WithoutColumnsEverythingStandsInOneRow) {
  const Image m = make_montage({{filled(2, 2, 1), ""}, {filled(2, 2, 1), ""}, {filled(2, 2, 1), ""}});
  EXPECT_EQ(m.width, 6);
  EXPECT_EQ(m.height, 2);
}

TEST(Montage, MoreColumnsThanTilesLeaveNoGap) {
  EXPECT_EQ(make_montage({{filled(2, 2, 1), ""}}, 5).width, 2);
}

TEST(Montage, LabelsStandAboveAndLeaveThePictureAlone) {
  const Image m = make_montage({{filled(64, 8, 0.5f), "one"}, {filled(64, 8, 0.25f), ""}});
  const int strip = m.height - 8;
  ASSERT_GT(strip, kGlyphHeight);
  float ink = 0;
  for (int y = 0; y < strip; ++y)
    for (int x = 0; x < m.width; ++x) {
      ink += m.at(x, y)[0];
      if (x >= 64) {
        EXPECT_EQ(m.at(x, y)[0], 0.0f) << "the second tile has no label";
      }
    }
  EXPECT_GT(ink, 20.0f);
  for (int y = strip; y < m.height; ++y)
    for (int x = 0; x < m.width; ++x) EXPECT_EQ(m.at(x, y)[0], x < 64 ? 0.5f : 0.25f);
}

TEST(Montage, LongLabelsAreCutAtTheTile) {
  const Image m = make_montage({{filled(20, 4, 0), "WWWWWWWWWWWW"}, {filled(20, 4, 0), ""}});
  for (int y = 0; y < m.height; ++y)
    for (int x = 20; x < 40; ++x) EXPECT_EQ(m.at(x, y)[0], 0.0f);
}

TEST(Montage, RefusesWhatCannotBeOnePicture) {
  EXPECT_THROW(make_montage({}), InputError);
  EXPECT_THROW(make_montage({{filled(2, 2, 0), ""}, {filled(3, 2, 0), ""}}), InputError);
  std::vector<MontageTile> wide(3, {filled(kMaxImageSide / 2, 1, 0), ""});
  EXPECT_THROW(make_montage(wide), InputError);
  EXPECT_NO_THROW(make_montage(wide, 2));
}

TEST(BitmapFont, SmallLettersAreCapitalsAndUnknownOnesBlank) {
  Image small(16, 9), capital(16, 9), unknown(16, 9);
  draw_text(small, "ab", 1, 1, 1, 16);
  draw_text(capital, "AB", 1, 1, 1, 16);
  draw_text(unknown, "~\xff", 1, 1, 1, 16);
  EXPECT_EQ(small.pixels, capital.pixels);
  EXPECT_GT(sum(capital), 0.0f);
  EXPECT_EQ(sum(unknown), 0.0f);
}

TEST(BitmapFont, DrawsNothingOutside) {
  Image image(4, 4);
  draw_text(image, "888", -3, -3, 2, 100);
  draw_text(image, "8", 2, 2, 3, 100);
  EXPECT_LE(sum(image), 4.0f * 4.0f * 3.0f);
}

}  // namespace

}  // namespace lightwell
