"""A client of `twinarm lab` that is no browser: HTTP and WebSocket with Python's own library alone.

For tests and measurements. What goes over the wire: docs/reference/lab_protocol.md.

    lab = Lab(url)                          # the address that the program has printed, token included
    lab.get("/scene")                       # Reply(status, headers, body)
    live = lab.live()
    live.do("request_control"); live.do("set", changes=["coupling.stiffness=800"])
    state = live.wait_for("state", lambda s: s["playing"])
    frame = live.wait_for("frame")          # a Frame: .time, .channels, ..
    with lab.stalled(): ...                 # a client that never reads
"""
import base64
import collections
import hashlib
import http.client
import json
import os
import select
import socket
import struct
import time
import urllib.parse

from waiting import TIMEOUT

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
FRAME_MAGIC, HISTORY_MAGIC = 0x31465754, 0x31485754
FRAME_HEAD = struct.Struct("<IIdddQ10I")

Reply = collections.namedtuple("Reply", "status headers body")


class Lab:
    """The server at an address: who has the token has the cookie from then on."""

    def __init__(self, url):
        parts = urllib.parse.urlsplit(url)
        self.host, self.port, self.url = parts.hostname, parts.port, url
        self.cookie = None
        reply = self.get(parts.path + "?" + parts.query)
        if reply.status != 200:
            raise ConnectionError(f"{url}: {reply.status} {reply.body[:200]!r}")
        self.page = reply.body
        self.cookie = reply.headers["Set-Cookie"].split(";")[0]

    def ask(self, method, path, body=None, headers=None):
        connection = http.client.HTTPConnection(self.host, self.port, timeout=TIMEOUT)
        try:
            fields = {"Cookie": self.cookie} if self.cookie else {}
            connection.request(method, path, body, fields | (headers or {}))
            reply = connection.getresponse()
            return Reply(reply.status, reply.headers, reply.read())
        finally:
            connection.close()

    def get(self, path, **headers):
        return self.ask("GET", path, headers=headers)

    def post(self, path, body):
        return self.ask("POST", path, body)

    def upload(self, name, body, live):
        """As the page of `live` does it."""
        secret = json.loads(live.newest["state"])["secret"] if live.newest.get("state") else live.wait_for(
            "state")["secret"]
        return self.post(f"/open?name={name}&secret={secret}", body)

    def history(self, since=0.0):
        return History(self.get(f"/history?from={since!r}").body)

    def live(self):
        return LiveSocket(self.host, self.port, self.cookie)

    def stalled(self):
        """Takes part, and reads nothing; hold it, and close it."""
        return self.live()


class LiveSocket:
    """One WebSocket. Pings are answered; of each kind the newest message is kept in `newest`."""

    def __init__(self, host, port, cookie):
        self.socket = socket.create_connection((host, port), timeout=TIMEOUT)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.unread = bytearray()
        self.pieces = []  # of a message that comes in several frames
        self.waiting = collections.deque()  # messages that nobody has looked at
        self.newest, self.count, self.bytes = {}, collections.Counter(), 0
        self.close_code, self.close_reason = None, ""
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /live HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nCookie: {cookie}\r\n"
                             f"Sec-WebSocket-Key: {key}\r\n\r\n").encode())
        head = b""
        while not head.endswith(b"\r\n\r\n"):  # not one byte of what follows
            got = self.socket.recv(1)
            if not got:
                raise ConnectionError("the server hung up in the handshake")
            head += got
        guid = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
        accept = base64.b64encode(hashlib.sha1((key + guid).encode()).digest())
        if not head.startswith(b"HTTP/1.1 101") or accept not in head:
            raise ConnectionError((head + self.socket.recv(4096)).decode("latin-1"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def fileno(self):
        return self.socket.fileno()

    def close(self):
        self.socket.close()

    def send_frame(self, opcode, payload):
        mask, size = os.urandom(4), len(payload)
        length = (struct.pack(">B", 0x80 | size) if size < 126 else
                  struct.pack(">BH", 0xfe, size) if size < 65536 else struct.pack(">BQ", 0xff, size))
        key = int.from_bytes((mask * (size // 4 + 1))[:size], "little")
        masked = (int.from_bytes(payload, "little") ^ key).to_bytes(size, "little")
        self.socket.sendall(bytes([0x80 | opcode]) + length + mask + masked)

    def say(self, text):
        self.send_frame(TEXT, text.encode())

    def do(self, command, **details):
        self.say(json.dumps({"do": command, **details}))

    def pump(self):
        """What has arrived, as (kind, raw bytes); waits for some first. Empty: only part of one."""
        got = self.socket.recv(1 << 18)
        if not got:
            raise ConnectionError(f"the server has hung up ({self.close_code} {self.close_reason})")
        self.unread += got
        messages = []
        while (frame := self._frame()) is not None:
            opcode, is_last, payload = frame
            if opcode == PING:
                self.send_frame(PONG, payload)
            elif opcode == CLOSE:
                self.close_code = int.from_bytes(payload[:2], "big")
                self.close_reason = payload[2:].decode()
            elif opcode != PONG:
                self.pieces.append((opcode, payload))
                if is_last:
                    opcode, payload = self.pieces[0][0], b"".join(p for _, p in self.pieces)
                    self.pieces.clear()
                    messages.append((kind_of(opcode, payload), payload))
        for kind, payload in messages:
            self.newest[kind] = payload
            self.count[kind] += 1
            self.bytes += len(payload)
        return messages

    def _frame(self):
        data = self.unread
        if len(data) < 2:
            return None
        size, at = data[1] & 0x7f, 2
        if size >= 126:
            more = 2 if size == 126 else 8
            if len(data) < 2 + more:
                return None
            size, at = int.from_bytes(data[2:2 + more], "big"), 2 + more
        if len(data) < at + size:
            return None
        frame = data[0] & 15, bool(data[0] & 0x80), bytes(data[at:at + size])
        del data[:at + size]
        return frame

    def messages(self, timeout=10.0):
        """Messages as they come, (kind, decoded), until the wait is over."""
        end, poll = time.monotonic() + timeout, select.poll()  # any number of descriptors
        poll.register(self.socket, select.POLLIN)
        while self.waiting or (left := end - time.monotonic()) > 0:
            if self.waiting:
                kind, payload = self.waiting.popleft()
                yield kind, decoded(kind, payload)
            elif poll.poll(1000 * left):
                self.waiting.extend(self.pump())

    def wait_for(self, kind, condition=lambda message: True, timeout=TIMEOUT):
        """The next message of a kind for which a condition holds; TimeoutError if none comes."""
        last = None
        for got, message in self.messages(timeout):
            if got == kind:
                last = message
                if condition(message):
                    return message
        raise TimeoutError(f"no such {kind} within {timeout} s; the last: {str(last)[:2000]}")


def kind_of(opcode, payload):
    if opcode == BINARY:
        return "frame" if int.from_bytes(payload[:4], "little") == FRAME_MAGIC else "binary"
    return json.loads(payload).get("kind", "unknown")


def decoded(kind, payload):
    return Frame(payload) if kind == "frame" else payload if kind == "binary" else json.loads(payload)


class Arrays:
    """Typed arrays one after the other, each from the next multiple of 8 bytes."""

    def __init__(self, data, at):
        self.data, self.at = memoryview(data), at

    def take(self, code, count):
        self.at = (self.at + 7) // 8 * 8
        size = struct.calcsize(code) * count
        if self.at + size > len(self.data):
            raise ValueError(f"{len(self.data)} bytes are too few: {self.at + size} are reported")
        array = self.data[self.at:self.at + size].cast(code)
        self.at += size
        return array


class Frame:
    """A frame: its head as attributes, its arrays as flat memoryviews."""

    def __init__(self, data):
        (magic, self.scene, self.time, self.stamp, self.input_age, self.step, self.number, self.flags,
         channels, works, layers, instances, labels, size, bodies, _) = FRAME_HEAD.unpack_from(data)
        if magic != FRAME_MAGIC:
            raise ValueError(f"a frame begins with {magic:#x}")
        arrays = Arrays(data, FRAME_HEAD.size)
        self.layers, self.instances, self.labels = layers, instances, labels
        self.channels, self.works = arrays.take("d", channels), arrays.take("d", works)
        self.link, self.target = arrays.take("f", 7 * bodies), arrays.take("f", 7 * bodies)
        self.position, self.scale = arrays.take("f", 3 * instances), arrays.take("f", 3 * instances)
        self.turn = arrays.take("h", 4 * instances)
        self.label_position, self.label_offset = arrays.take("f", 3 * labels), arrays.take("h", 2 * labels)
        self.text_end = arrays.take("I", labels)
        self.first, self.first_label = arrays.take("I", layers + 1), arrays.take("I", layers + 1)
        self.mesh, self.body = arrays.take("H", instances), arrays.take("H", instances)
        self.color, self.instance_flags = arrays.take("B", 4 * instances), arrays.take("B", instances)
        self.shininess, self.texture = arrays.take("B", instances), arrays.take("B", instances)
        self.text = bytes(arrays.take("B", size)).decode()
        if arrays.at != len(data):
            raise ValueError(f"{len(data)} bytes, of which {arrays.at} are reported of")

    paused = property(lambda self: bool(self.flags & 1))
    looked_back = property(lambda self: bool(self.flags & 2))
    diverged = property(lambda self: bool(self.flags & 4))

    def label_texts(self):
        data, start, texts = self.text.encode(), 0, []
        for end in self.text_end:
            texts.append(data[start:end].decode())
            start = end
        return texts

    def __repr__(self):
        return f"Frame(number={self.number}, time={self.time}, step={self.step}, flags={self.flags})"


class History:
    """What is remembered: times, and channels and works of each."""

    def __init__(self, data):
        magic, self.scene, self.frames, self.channel_count, self.row_count, _ = struct.unpack_from("<6I", data)
        if magic != HISTORY_MAGIC:
            raise ValueError(f"a history begins with {magic:#x}")
        arrays = Arrays(data, 24)
        self.time = arrays.take("d", self.frames)
        self.channels = arrays.take("d", self.frames * self.channel_count)
        self.works = arrays.take("d", self.frames * self.row_count)

    def channel(self, index):
        return self.channels[index::self.channel_count].tolist()
