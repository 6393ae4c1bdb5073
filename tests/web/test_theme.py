"""Contrast of the pages' colours: text and curves against their background, curves among each other,
with colour vision deficiencies too."""
import itertools
import unittest

from theme_colors import EYES, contrast, delta_e, lab, over, themes

TEXT, GRAPHICS = 4.5, 3.0  # WCAG 2.1, 1.4.3 and 1.4.11
APART = 10.0  # CIEDE2000; 1: just noticeable
CURVES = [f"--c{i}" for i in range(8)]
# Text colours and backgrounds. On the 3-D view: the card over white and over black.
WORDS = ("--ink", "--muted", "--accent", "--ok", "--near", "--beyond")
GROUNDS = ("--surface", "--paper", "--accent-soft", "--near-soft", "--beyond-soft")


class ThemeColors(unittest.TestCase):
    def test_formulas_agree_with_published_values(self):
        # Sharma, Wu and Dalal 2005, table 1: pairs 1, 7, 17, 24, 31, 34.
        pairs = [((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
                 ((50, 0, 0), (50, -1, 2), 2.3669), ((50, 2.5, 0), (73, 25, -18), 27.1492),
                 ((50, 2.5, 0), (50, 3.2592, 0.3350), 1.0000),
                 ((22.7233, 20.0904, -46.6940), (23.0331, 14.9730, -42.5619), 2.0373),
                 ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082)]
        for one, other, wanted in pairs:
            self.assertAlmostEqual(delta_e(one, other), wanted, places=4)
        self.assertAlmostEqual(contrast((0, 0, 0, 1), (255, 255, 255, 1)), 21)
        self.assertAlmostEqual(contrast((118, 118, 118, 1), (255, 255, 255, 1)), 4.54, places=2)
        self.assertAlmostEqual(lab((255, 255, 255, 1))[0], 100, places=3)
        for eyes in EYES:  # grey is grey to all
            self.assertLess(max(map(abs, lab((128, 128, 128, 1), eyes)[1:])), 0.1)

    def test_contrast_of_text(self):
        for theme, colors in themes().items():
            for word, ground in itertools.product(WORDS, GROUNDS):
                with self.subTest(theme=theme, text=word, ground=ground):
                    self.assertGreaterEqual(contrast(colors[word], colors[ground]), TEXT)
            with self.subTest(theme=theme, text="on the main button"):
                self.assertGreaterEqual(contrast(colors["--surface"], colors["--accent"]), TEXT)

    def test_contrast_of_text_on_the_3d_view(self):
        for theme, colors in themes().items():
            for word, behind in itertools.product(WORDS, ((0, 0, 0, 1), (255, 255, 255, 1))):
                ground = over(colors["--card"], behind)
                with self.subTest(theme=theme, text=word, behind=behind):
                    self.assertGreaterEqual(contrast(colors[word], ground), TEXT)

    def test_contrast_of_curves_icons_and_field_borders(self):
        for theme, colors in themes().items():
            for name in (*CURVES, "--edge", "--branch"):
                with self.subTest(theme=theme, color=name):
                    self.assertGreaterEqual(contrast(colors[name], colors["--surface"]), GRAPHICS)

    def test_curves_are_distinguishable_with_colour_vision_deficiencies(self):
        for theme, colors in themes().items():
            for eyes in EYES:
                seen = {name: lab(colors[name], eyes) for name in (*CURVES, "--ink")}
                for one, other in itertools.combinations(seen, 2):
                    with self.subTest(theme=theme, eyes=eyes, curves=(one, other)):
                        self.assertGreaterEqual(delta_e(seen[one], seen[other]), APART)


if __name__ == "__main__":
    unittest.main()
