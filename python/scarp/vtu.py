"""Reads the frames that scarp writes: VTK unstructured grids (.vtu) with appended raw data, and their collection (.pvd)."""

import os
import re
import xml.etree.ElementTree as ElementTree

import numpy as np

_TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


class FormatError(Exception):
    """A file that is not what scarp writes."""


def read_vtu(path):
    """The arrays of one frame: {"Points": (n, 3), name: (n,) or (n, components), "connectivity": ..., ...}."""
    with open(path, "rb") as file:
        content = file.read()
    start = content.find(b"<AppendedData")
    mark = content.find(b"_", start)
    if start < 0 or mark < 0:
        raise FormatError(f"{path} is not a frame of scarp: it has no appended data")
    header = content[:start].decode("ascii", "replace")
    arrays = {}
    for tag in re.findall(r"<DataArray ([^>]*)/>", header):
        attribute = dict(re.findall(r'(\w+)="([^"]*)"', tag))
        at = mark + 1 + int(attribute["offset"])
        size = int(np.frombuffer(content, "<u8", 1, at)[0])
        kind = np.dtype(_TYPES[attribute["type"]])
        if at + 8 + size > len(content):
            raise FormatError(f"{path} is cut short in the array {attribute['Name']}")
        values = np.frombuffer(content, kind, size // kind.itemsize, at + 8)
        components = int(attribute.get("NumberOfComponents", "1"))
        arrays[attribute["Name"]] = values.reshape(-1, components) if components > 1 else values
    return arrays


def read_pvd(path):
    """[(time, path of the frame), ...] in the order of the file."""
    folder = os.path.dirname(path)
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise FormatError(f"{path} is not a collection of frames: {error}") from error
    return [(float(d.get("timestep")), os.path.join(folder, d.get("file"))) for d in root.iter("DataSet")]
