"""The contact sheet: all figures, labeled, in two columns."""
from PIL import Image, ImageDraw

from paint import INK, font

WIDTH, GAP, HEAD = 640, 14, 22


def contact(pictures):
    """`pictures` of figures, shrunk to one width and put where a column is shortest, in few colors."""
    cells = []
    for figure, picture in pictures.items():
        share = min(WIDTH / picture.width, 1)
        small = picture.resize((round(picture.width * share), round(picture.height * share)), Image.Resampling.LANCZOS)
        cell = Image.new("RGB", (WIDTH, small.height + HEAD), "white")
        cell.paste(small, ((WIDTH - small.width) // 2, HEAD))
        ImageDraw.Draw(cell).text((4, 2), f"{figure.number}  {figure.name}", INK, font(15))
        cells.append(cell)
    half, columns, tall = sum(cell.height + GAP for cell in cells) / 2, ([], []), 0
    for cell in cells:
        columns[0 if tall < half else 1].append(cell)
        tall += cell.height + GAP
    height = max(sum(cell.height + GAP for cell in column) for column in columns)
    out = Image.new("RGB", (2 * WIDTH + 3 * GAP, height + GAP), "white")
    for k, column in enumerate(columns):
        top = GAP
        for cell in column:
            out.paste(cell, (GAP + k * (WIDTH + GAP), top))
            top += cell.height + GAP
    return out.quantize(255, Image.Quantize.MEDIANCUT, kmeans=4, dither=Image.Dither.NONE)
