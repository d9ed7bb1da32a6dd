"""What the page draws, pixel by pixel: grains of known place and colour, what hides what, bridges, clumps, other shapes, walls."""
import math

import pytest

browser = pytest.importorskip("browser")
if browser.what_is_missing():
    pytest.skip(browser.what_is_missing(), allow_module_level=True)

VIRIDIS = ["440154", "48287c", "3e4a89", "31688e", "26828e", "1f9e89", "35b779", "6dcd59", "b4de2c", "fde725"]


def viridis(share):
    """The colour of the map, between the ten that define it."""
    place = round(share * 255) / 255 * 9
    k = min(int(place), 8)
    ends = [[int(c[i:i + 2], 16) for i in (0, 2, 4)] for c in VIRIDIS[k:k + 2]]
    return [a + (b - a) * (place - k) for a, b in zip(*ends)]


def near(colour, expected, by=2):
    return max(abs(a - b) for a, b in zip(colour, expected)) <= by


def along(viewer, point):
    """The pixel of a point (m) in the picture."""
    return viewer("const [x, y] = s.project(arguments[0].map((c, k) => c - v.origin[k])); return [Math.floor(x), Math.floor(y)]", point)


@pytest.fixture
def scene(serve, write_frames):
    """JavaScript with the viewer `v` and its scene `s`, seen from the front, coloured by the speed."""
    write_frames("picture", "wet")
    server = serve()
    with browser.page() as page:
        page.open(server, "run=wet%2Frun")
        page.wait("pendular.viewer && pendular.viewer.loads")
        view = lambda text, *arguments: page.js(f"const v = pendular.viewer, s = v.scene; {text}", *arguments)
        view("s.camera.from(0, 0); s.look.walls = false; s.lookAtAll(); s.camera.zoom(0.9); s.render({finish: true})")
        view.page, view.server = page, server
        yield view
        assert page.problems() == []


def colour_at(scene, point):
    return scene("s.render({finish: true}); return s.pixel(...arguments[0])", along(scene, point))


def test_the_picture(scene):
    # A grain shows the full colour of its value where it faces the eye; speeds are 0 to 8 m/s, the colours' range.
    assert scene("return s.look.range") == [0, 8]
    eye = scene("return [...s.camera.eye].map((c, k) => c + v.origin[k])")
    for k in range(9):
        centre = [3e-3 * (k % 3 - 1), 0, 3e-3 * (k // 3 - 1)]
        way = [e - c for e, c in zip(eye, centre)]
        length = math.sqrt(sum(w * w for w in way))
        facing = [c + 1e-3 * w / length for c, w in zip(centre, way)]
        assert near(colour_at(scene, facing), viridis(k / 8)), (k, colour_at(scene, facing), viridis(k / 8))

    # Edges: just within the outline there is a grain, just outside there is none.
    background = scene("return s.look.background.map((c) => Math.round(255 * c))")
    assert not near(colour_at(scene, [3e-3 + 0.95e-3, 0, 3e-3]), background, 10)
    assert near(colour_at(scene, [3e-3 + 1.05e-3, 0, 3e-3]), background)

    # The small grain behind the fifth is hidden, and seen from behind.
    behind = [0, 4e-3, 0]
    assert not near(colour_at(scene, behind), viridis(1), 30)
    scene("s.camera.from(Math.PI, 0)")
    assert near(colour_at(scene, [0, 4.5e-3, 0]), viridis(1), 6)
    scene("s.camera.from(0, 0)")

    # The bridge of 0.1 ul is blue, as wide as its volume says, and goes with its box.
    middle = [-1.5e-3, -3e-4, -3e-3]
    blue = colour_at(scene, middle)
    assert blue[2] > 1.5 * blue[0] and blue[2] > blue[1] > blue[0], blue
    radius = math.sqrt(2 * 5e-4 * (math.sqrt((1e-3) ** 2 + 1e-10 / (math.pi * 5e-4)) - 1e-3))
    assert not near(colour_at(scene, [-1.5e-3, 0, -3e-3 + 0.93 * radius]), background, 10)
    assert near(colour_at(scene, [-1.5e-3, 0, -3e-3 + 1.07 * radius]), background)
    scene("s.look.bridges = false")
    assert near(colour_at(scene, middle), background)

    # A droplet is a small blue ball, and goes with its box.
    drop = [1.5e-3, -2.9e-4, 1.5e-3]
    blue = colour_at(scene, drop)
    assert near(blue, [38, 115, 217], 4), blue
    assert near(colour_at(scene, [1.5e-3 + 3.3e-4, 0, 1.5e-3]), background)
    scene("s.look.droplets = false")
    assert near(colour_at(scene, drop), background)
    scene("s.look.droplets = true")

    # A clump has the outline of its two spheres, without a gap between them.
    for z in (0, 6e-4, 1.2e-3):
        assert not near(colour_at(scene, [6e-3, 0, z]), background, 10)

    # A cube is drawn in place of its sphere: flat to its edges, and nothing beyond them.
    inside, outside = colour_at(scene, [-6e-3 + 7e-4, -8e-4, 7e-4]), colour_at(scene, [-6e-3 + 1.1e-3, 0, 0])
    assert near([c / inside[1] for c in inside], [c / viridis(6 / 8)[1] for c in viridis(6 / 8)], 0.1)
    assert near(outside, background)

    # A wall lets through: it makes the background darker, and grains before it are as they were.
    under, grain = [7e-3, 4e-3, -5e-3], [0, -1e-3, 3e-3]
    scene("s.camera.from(0, 0.5)")
    without, before = colour_at(scene, under), colour_at(scene, grain)
    scene("s.look.walls = true")
    assert near(without, background) and not near(colour_at(scene, under), background, 8)
    assert near(colour_at(scene, grain), before)

    # A wall coloured by its wear: the left half has none, the right one 2 um; it lets little through then.
    scene("v.loads = 0; v.wallSelect.value = 'wear_depth_m'; v.wallSelect.dispatchEvent(new Event('change'))")
    scene.page.wait("pendular.viewer.loads > 0")
    left, right = colour_at(scene, [-7e-3, 4e-3, -5e-3]), colour_at(scene, [7e-3, 4e-3, -5e-3])
    assert left[2] > 1.3 * left[1] and right[0] > 2 * right[2] and right[1] > 2 * right[2], (left, right)
    assert scene("return [v.wallLegend.high.textContent, v.wallLegend.unit.textContent]") == ["2e-6", "m"]
    scene("v.loads = 0; v.wallSelect.value = ''; v.wallSelect.dispatchEvent(new Event('change'))")
    scene.page.wait("pendular.viewer.loads > 0")
    assert near(colour_at(scene, grain), before)

    # The cut takes away what is on its other side; a range that is fixed changes the colours.
    scene("s.camera.from(0, 0); s.look.walls = false; s.look.clip = {axis: 'x', share: 0.5, keepsHigh: false}")
    assert near(colour_at(scene, [3e-3, 0, 3e-3]), background)
    assert not near(colour_at(scene, [-3e-3, 0, 3e-3]), background, 10)
    scene("s.look.clip = null; s.look.range = [0, 80]")
    assert near(colour_at(scene, [0, -1e-3, 3e-3]), viridis(7 / 80), 6)
    scene("s.look.range = [0, 8]; s.look.bridges = true")

    # Who is pointed at: identity and fields.
    x, y = along(scene, [3e-3, 0, 3e-3])
    assert scene("return s.pick(...arguments[0])", [x, y]) == {"kind": "grain", "row": 8}
    scene("v.showPicked({kind: 'grain', row: 8})")
    scene.page.wait("pendular.viewer.picked.innerText.includes('Grain 108')")
    text = scene.page.js("return pendular.viewer.picked.innerText")
    assert "velocity (m/s)\t0, 0, 8" in text and "radius (m)\t0.001" in text

    # And a contact, where contacts are shown: it has the force of its file.
    scene("s.look.contacts = true; s.look.grains = false; v.loads = 0; v.ask(0)")
    scene.page.wait("pendular.viewer.loads > 0")
    x, y = along(scene, [-1.5e-3, 0, -3e-3])
    assert scene("s.render({finish: true}); return s.pick(...arguments[0])", [x, y]) == {"kind": "contact", "row": 0}
    scene("v.showPicked({kind: 'contact', row: 0})")
    scene.page.wait("pendular.viewer.picked.innerText.includes('Contact')")
    assert "force (N)\t1e-4, 0, 0" in scene.page.js("return pendular.viewer.picked.innerText")
