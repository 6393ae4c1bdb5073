"""Three hundred hostile files, options and requests: scripts/check/hostile, which makes five thousand."""
import subprocess

import program
from program import ROOT, ProgramTest, main
from waiting import TIMEOUT


class HostileCases(ProgramTest):
    def test_each_is_accepted_or_refused_as_documented(self):
        if "san" in program.PROGRAM:
            return  # takes more memory and time than is allowed
        done = subprocess.run([ROOT / "scripts/check/hostile", "--short", "--program", program.PROGRAM],
                              capture_output=True, text=True, timeout=4 * TIMEOUT)
        self.assertEqual(done.returncode, 0, done.stdout[-4000:] + done.stderr[-1000:])


if __name__ == "__main__":
    main()
