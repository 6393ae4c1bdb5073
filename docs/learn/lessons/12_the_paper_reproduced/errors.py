"""Time, and tracking errors of joints 1 and 2 in degrees, of a run as JSON: errors.py RUN.json"""
import json
import math
import sys

for sample in json.load(open(sys.argv[1]))["samples"]:
    target = next(iter(sample["targets"].values()))["q"]
    errors = [math.degrees(target[joint] - sample["q"][joint]) for joint in ("joint1", "joint2")]
    print(sample["t"], *errors, sep=",")
