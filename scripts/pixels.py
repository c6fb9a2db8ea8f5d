"""Pixels of the EXR files that lightwell writes and of the shared references, and masks as PNG. Standard library only.

Pictures are lists of rows of (r, g, b).
"""

import struct
import zlib

LINES = {0: 1, 2: 1, 3: 16}  # rows in a block, by compression: none, zip of one row, zip
TYPES = {1: ("e", 2), 2: ("f", 4)}  # half, float


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _header(data):
    """({attribute: bytes}, where the table of offsets starts)"""
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(chlist):
    channels, at = [], 0
    while chlist[at]:
        name, at = _text(chlist, at)
        kind, = struct.unpack_from("<i", chlist, at)
        channels.append((name, TYPES[kind]))
        at += 16
    return channels


def _unpack(block):
    """Undoes OpenEXR's ZIP: deflate, then differences of neighbouring bytes, then two interleaved halves."""
    data = bytearray(zlib.decompress(block))
    value = data[0]
    for i in range(1, len(data)):
        value = (value + data[i] - 128) & 255
        data[i] = value
    half = (len(data) + 1) // 2
    result = bytearray(len(data))
    result[0::2], result[1::2] = data[:half], data[half:]
    return bytes(result)


def load_exr(path):
    with open(path, "rb") as f:
        data = f.read()
    attributes, table = _header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = _channels(attributes["channels"])
    lines = LINES[attributes["compression"][0]]
    row_bytes = width * sum(size for _, (_, size) in channels)
    rows = []
    for block in range((height + lines - 1) // lines):
        at, = struct.unpack_from("<Q", data, table + 8 * block)
        _, size = struct.unpack_from("<ii", data, at)
        raw = data[at + 8:at + 8 + size]
        wanted = row_bytes * min(lines, height - block * lines)
        if size < wanted:
            raw = _unpack(raw)
        for line in range(len(raw) // row_bytes):
            offset, planes = line * row_bytes, {}
            for name, (code, size) in channels:
                planes[name] = struct.unpack_from("<%d%s" % (width, code), raw, offset)
                offset += width * size
            gray = planes.get("Y")
            rows.append(list(zip(planes["R"], planes["G"], planes["B"])) if gray is None else
                        list(zip(gray, gray, gray)))
    return rows


def save_mask(path, mask):
    """Rows of booleans as a PNG that lightwell compare --mask takes."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    body = zlib.compress(b"".join(b"\0" + bytes(255 if m else 0 for m in row) for row in mask))
    header = struct.pack(">IIBBBBB", len(mask[0]), len(mask), 8, 0, 0, 0, 0)
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


def spread(rows, radius):
    """(smallest, largest) of numbers within `radius` pixels, as two pictures."""
    def along(rows, best):
        return [[best(row[max(0, x - radius):x + radius + 1]) for x in range(len(row))] for row in rows]

    def both(best):
        turned = [list(column) for column in zip(*along(rows, best))]
        return [list(row) for row in zip(*along(turned, best))]
    return both(min), both(max)


def save_exr(path, rows):
    """Rows of (r, g, b) as uncompressed 32-bit floats."""
    def attribute(name, kind, content):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(content)) + content
    width, height = len(rows[0]), len(rows)
    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = b"v/1\x01\x02\0\0\0" + b"".join((
        attribute("channels", "chlist", channels), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    size = 12 * width
    start = len(header) + 8 * height
    with open(path, "wb") as f:
        f.write(header + b"".join(struct.pack("<Q", start + y * (8 + size)) for y in range(height)))
        for y, row in enumerate(rows):
            planes = [pixel[c] for c in (2, 1, 0) for pixel in row]
            f.write(struct.pack("<ii", y, size) + struct.pack("<%df" % len(planes), *planes))
