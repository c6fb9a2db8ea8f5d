"""The simplest streams that decoders of Draco and meshoptimizer read. Python 3 standard library only.

They compress nothing: what counts is that a decoder has to run.
"""

import struct

GROUP = 16  # vertices whose bytes are stored together


def _varint(value):
    """Seven bits a byte, the lowest first; the highest bit says that more follow."""
    result = bytearray()
    while value > 127:
        result.append(value & 127 | 128)
        value >>= 7
    return bytes(result) + bytes([value])


def draco_mesh(indices, positions, normals, texcoords):
    """Draco bitstream 2.2: a mesh in sequential coding, all its values raw; attribute ids 0, 1, 2 in this order."""
    mesh, sequential, raw_indices, raw_values, float32 = 1, 0, 1, 0, 9
    count = len(positions)
    size = "B" if count < 256 else "H"
    stream = struct.pack("<5sBBBBH", b"DRACO", 2, 2, mesh, sequential, 0)
    stream += _varint(len(indices) // 3) + _varint(count) + bytes([raw_indices]) + struct.pack("<%d%s" % (len(indices), size), *indices)
    attributes = ((0, positions), (1, normals), (3, texcoords))  # kinds: position, normal, texture coordinate
    stream += bytes([1]) + _varint(len(attributes))
    for number, (kind, rows) in enumerate(attributes):
        stream += bytes([kind, float32, len(rows[0]), 0]) + _varint(number)
    stream += bytes([raw_values] * len(attributes))
    return stream + b"".join(struct.pack("<%df" % len(row), *row) for _, rows in attributes for row in rows)


def meshopt_vertices(data, stride):
    """EXT_meshopt_compression, mode ATTRIBUTES, version 0: `data` is vertices of `stride` bytes."""
    block = min(8192 // stride // GROUP * GROUP, 256)
    vertices = [data[i:i + stride] for i in range(0, len(data), stride)]
    stream, last = bytearray([0xa0]), vertices[0]
    for first in range(0, len(vertices), block):
        part = vertices[first:first + block]
        groups = (len(part) + GROUP - 1) // GROUP
        for byte in range(stride):
            differences = bytearray()
            for before, vertex in zip([last, *part], part):
                change = (vertex[byte] - before[byte] + 128) % 256 - 128
                differences.append((change << 1 ^ change >> 7) & 255)
            differences += bytes(groups * GROUP - len(differences))
            stream += b"\xff" * ((groups + 3) // 4)  # two bits a group: 3 says that its 16 bytes follow
            stream += differences
        last = part[-1]
    return bytes(stream) + bytes(max(0, 32 - stride)) + vertices[0]


def meshopt_indices(indices):
    """EXT_meshopt_compression, mode INDICES: differences to the index before; the lowest bit chooses one of two of those."""
    stream, last = bytearray([0xd1]), 0
    for index in indices:
        change = index - last
        stream += _varint((change << 1 if change >= 0 else (-change << 1) - 1) << 1)
        last = index
    return bytes(stream) + bytes(4)
