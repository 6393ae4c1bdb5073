"""Who looks on in scripts/check/soak_lab: each kind of client is a class.

Clients tell the soak what they saw (`newcomers`, `stalls`, `hands`, `knobs`, `asked`, fault()), and ask it when they
are to be read (watch(), forget()).
"""
import json
import socket
import struct
import threading
import time

from lab_program import Hand
from live_socket import CLOSE, FRAME_HEAD


class Client:
    """Reads what comes. `tick` is called some sixty times a second, `take` when there is something to read."""

    def __init__(self, soak):
        self.soak, self.live = soak, None
        self.connect()

    def connect(self):
        self.live = self.soak.lab.live()
        self.came, self.is_new = time.monotonic(), True
        self.frames, self.time, self.stamp, self.read = 0, -1.0, 0.0, None
        self.soak.watch(self)

    def leave(self, politely=True):
        self.soak.forget(self)
        try:
            if politely:
                self.live.send_frame(CLOSE, struct.pack(">H", 1000))
            else:  # as a cable that is pulled out: the socket says nothing but a reset
                self.live.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        except OSError:
            pass
        self.live.close()
        self.live = None

    def take(self):
        for kind, payload in self.live.pump():
            if kind == "frame":
                t, self.stamp = FRAME_HEAD.unpack_from(payload)[2:4]
                if t < self.time:
                    self.soak.fault(f"a frame of {t} s came after one of {self.time} s")
                self.time = t
                self.frames += 1
        if self.is_new and {"scene", "state", "frame"} <= self.live.newest.keys():
            self.is_new = False
            self.soak.newcomers.append(time.monotonic() - self.came)

    def tick(self, now):
        pass

    def state(self):
        """The newest; of the same text the same object."""
        text = self.live.newest["state"]
        if text is not self.read:
            self.read, self.reported = text, json.loads(text)
        return self.reported


class Staller(Client):
    """Reads nothing for a while, then all that waits, then nothing again; or it goes."""
    stalls, until, reads_until = False, 0.0, 0.0

    def tick(self, now):
        if self.live is None:
            return self.connect()
        if self.stalls and now > self.until:
            self.stalls, self.reads_until = False, now + 2
            self.soak.stalls += 1
            if self.soak.random.random() < 0.3:
                return self.leave(politely=False)
            self.soak.watch(self)
        elif not self.stalls and not self.is_new and now > self.reads_until:
            self.soak.forget(self)
            self.stalls, self.until = True, now + self.soak.random.uniform(3, self.soak.longest_stall)
        return None


class Comer(Client):
    """Comes, is reported everything, and goes."""
    until = 0.0

    def tick(self, now):
        if self.live is None:
            if now > self.until:
                self.connect()
        elif not self.is_new and now > self.came + self.soak.random.uniform(0.3, 60):
            self.leave(politely=self.soak.random.random() < 0.5)
            self.until = now + self.soak.random.uniform(0, 1)


class Mover(Client):
    """Has the hand by turns with another: moves a joint, turns a stiffness, gives the hand away."""
    hand, turned, got, asked, is_giving = None, 0.0, 0.0, 0.0, False

    def tick(self, now):
        if self.is_new:
            return
        if self.hand is None:
            self.hand = Hand(self.live)
        state = self.state()
        if state["controller"] != state["you"]:
            self.turned, self.got, self.is_giving = now, now, False
            if state["you"] not in state["control_requests"] and now > self.asked + 1:
                self.asked = now
                self.live.do("request_control")
            return
        if self.is_giving:
            return
        self.hand.move()
        if now > self.turned + 4:
            self.turned = now
            self.turn_a_knob(state)
        if now > self.got + 10 and state["control_requests"]:
            self.is_giving = True
            self.soak.hands += 1
            self.live.do("grant_control", to=state["control_requests"][0])

    def turn_a_knob(self, state):
        """A stiffness, between half and all of what it was at first."""
        for knob in state["parameters"]:
            if knob["path"].endswith("stiffness"):
                first = self.soak.first_values.setdefault(knob["path"], knob["value"])
                value = first * self.soak.random.uniform(0.5, 1)
                self.live.do("set", changes=[f"{knob['path']}={value!r}"])
                self.soak.knobs += 1
                return


class Curious(Client):
    """Asks over HTTP, wants other layers, looks into bodies."""
    next = 0.0
    asks = None
    paths = ("/scene", "/frame.png?width=320&height=180", "/save", "/nothing/here")
    layers = ("bodies", "targets", "couplings", "contacts", "frames", "inertia", "momentum", "trails", "labels")

    def tick(self, now):
        if self.is_new or now < self.next or (self.asks and self.asks.is_alive()):
            return
        self.next = now + 2
        pick = self.soak.random
        self.live.do("layers", names=pick.sample(self.layers, pick.randint(1, len(self.layers))))
        self.live.do("inspect", on=pick.random() < 0.5, body=1)
        path = pick.choice([f"/history?from={self.time - 5!r}", *self.paths])
        self.asks = threading.Thread(target=self.ask, args=(path,), daemon=True)
        self.asks.start()

    def ask(self, path):
        try:
            status = self.soak.lab.get(path).status
        except OSError as error:
            status = str(error)
        if status != (404 if path == "/nothing/here" else 200):
            self.soak.fault(f"GET {path}: {status}")
        self.soak.asked += 1
