"""Curves on two logarithmic axes, as SVG."""
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 400, 70, 150, 30, 50
COLOURS = ["#1b6ca8", "#2a9d5c", "#c0392b", "#8e44ad", "#b8860b"]


def curves(title, x_name, y_name, series):
    """series: name -> [(x, y)], all above 0."""
    points = [p for line in series.values() for p in line]
    lows = [math.floor(math.log10(min(p[i] for p in points))) for i in (0, 1)]
    highs = [max(lows[i] + 1, math.ceil(math.log10(max(p[i] for p in points)) - 1e-9)) for i in (0, 1)]

    def place(x, y):
        across = (math.log10(x) - lows[0]) / (highs[0] - lows[0])
        up = (math.log10(y) - lows[1]) / (highs[1] - lows[1])
        return LEFT + across * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - up * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="18" font-size="14">{title}</text>']
    for e in range(lows[0], highs[0] + 1):
        x, y = place(10.0 ** e, 10.0 ** lows[1])
        out += [f'<path d="M{x:.1f} {y:.1f}V{TOP}" stroke="#ddd"/>',
                f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{10 ** e:,}</text>']
    for e in range(lows[1], highs[1] + 1):
        x, y = place(10.0 ** lows[0], 10.0 ** e)
        out += [f'<path d="M{x:.1f} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>',
                f'<text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** e:g}</text>']
    for i, (name, line) in enumerate(series.items()):
        path = "M" + " L".join("{:.1f} {:.1f}".format(*place(*p)) for p in line)
        colour = COLOURS[i % len(COLOURS)]
        out.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<text x="{WIDTH - RIGHT + 8}" y="{TOP + 14 + 18 * i}" fill="{colour}">{name}</text>')
    middle = (TOP + HEIGHT - BOTTOM) / 2
    out += [f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{HEIGHT - 12}" text-anchor="middle">{x_name}</text>',
            f'<text x="16" y="{middle:.0f}" text-anchor="middle" transform="rotate(-90 16 {middle:.0f})">{y_name}</text>',
            '</svg>']
    return "\n".join(out) + "\n"
