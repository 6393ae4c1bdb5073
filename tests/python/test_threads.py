"""Other threads of Python go on while a long call computes."""
import os
import signal
import threading

import numpy as np

from notebook import DOUBLE_PENDULUM, PUMA, ProgramTest, main, states, twinarm


class Threads(ProgramTest):
    def interrupted(self, call):
        """Whether another thread's SIGINT ends `call`, which sends none if it cannot run meanwhile."""
        started, ended = threading.Event(), threading.Event()

        def interrupt():
            started.wait()
            if not any(ended.wait(0.001) for _ in range(50)):  # runs only where it gets the lock
                os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        try:
            started.set()
            call()
            ended.set()
            return False
        except KeyboardInterrupt:
            return True
        finally:
            thread.join()

    def test_another_thread_interrupts_a_run(self):
        run = lambda: twinarm.simulate(PUMA, duration=60, step=1e-4, every=60)  # noqa: E731
        self.assertTrue(self.interrupted(run))

    def test_another_thread_interrupts_many_calls(self):
        model = twinarm.load(PUMA)
        many = [np.tile(row, (300_000, 1)) for row in (np.zeros(6), np.ones(6), np.zeros(6))]
        for call in twinarm.aba, twinarm.rnea:
            self.assertTrue(self.interrupted(lambda call=call: [call(model, *many) for _ in range(20)]), call)

    def test_a_model_serves_two_threads(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        given = [states(model, 20_000, seed) for seed in (1, 2)]
        alone = [twinarm.aba(model, *part) for part in given]
        found = [None, None]

        def work(k):
            found[k] = twinarm.aba(model, *given[k])

        threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k in range(2):
            np.testing.assert_array_equal(found[k], alone[k])

    def test_the_workspace_is_that_of_the_last_of_many_calls(self):
        model = twinarm.load(PUMA)
        q, qd, tau = states(model, 1000)
        many = twinarm.aba(model, q, qd, tau)
        after = model.workspace()
        twinarm.aba(model, q[-1], qd[-1], tau[-1])
        np.testing.assert_array_equal(many[-1], twinarm.aba(model, q[-1], qd[-1], tau[-1]))
        np.testing.assert_array_equal(after["IA"], model.workspace()["IA"])


if __name__ == "__main__":
    main()
