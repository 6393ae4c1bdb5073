"""What the examples share. Each belongs to the lesson of its own name, docs/learn/lessons/NAME/lesson.md."""
import pathlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]


def folder_of(script):
    """Of the lesson: its scenes and robots."""
    return ROOT / "docs" / "learn" / "lessons" / pathlib.Path(script).stem


def say(what, value):
    """Prints a number that the lesson checks, in its order: a test compares the two."""
    print(f"{what:66} = {value:.12g}")


def crossings(t, x):
    """The times at which a curve x (N,) over t (N,) passes zero, straight between its points."""
    before = np.flatnonzero(x[:-1] * x[1:] < 0)
    return t[before] - x[before] * (t[before + 1] - t[before]) / (x[before + 1] - x[before])


def picture(script, xlabel, *panels):
    """Draws panels below one another, each (ylabel, {label: (x, y)}), into out/NAME.png of the
    folder that one is in; without matplotlib nothing."""
    try:
        import matplotlib
    except ImportError:
        print("no picture: matplotlib is not there (Debian: python3-matplotlib)")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(len(panels), squeeze=False, figsize=(7, 3.2 * len(panels)))
    for axis, (ylabel, curves) in zip(axes[:, 0], panels):
        for label, (x, y) in curves.items():
            axis.plot(x, y, label=label)
        axis.set(xlabel=xlabel, ylabel=ylabel)
        axis.legend()
        axis.grid(alpha=0.3)
    figure.tight_layout()
    file = pathlib.Path("out") / (pathlib.Path(script).stem + ".png")
    file.parent.mkdir(exist_ok=True)
    figure.savefig(file)
    plt.close(figure)
    print(f"drawn: {file}")
