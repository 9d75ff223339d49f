"""Opens a show in Blender: its camera, its frames and their layers, and a scene seen through its hole.

    domefall states SHOW --format json > states.json
    domefall render SHOW --out FRAMES                  (with output: {layers: [...]} for layers)
    domefall render SHOW --out FRAMES --lens-map       (for --lens)
    blender [-b] [SCENE.blend] --python blender_show.py -- --states states.json --frames 'FRAMES/linear/NAME_#####.exr'
        [--lens 'FRAMES/lens/NAME_#####.exr' --sky SKY.exr] [--out 'OUT/#####.exr']

The camera `Domefall` is turned in each frame as the show's, in a world whose x is the way on which an orbit goes and
whose z is its north, with the hole along y. It is a panoramic camera of Cycles, or one of perspective for a rectilinear
picture. The compositor adds the layers as docs/compositing.md says, so that each can be graded by itself: titles over
sky + stars + disc + bodies + glare; without layers it shows the frames. With --lens it shows a picture of a whole sky (by
longitude and latitude, RA 0 in the middle, such as a panoramic render of a scene) as the hole lenses it. With --out it
renders and writes what the compositor shows, in floats. Tried with Blender 3.4.
"""

import argparse
import json
import math
import os
import re
import sys

import bpy
from mathutils import Matrix

# The panoramas of Cycles. It has no stereographic picture; a show's frames are composited all the same.
PANORAMAS = {'domemaster': 'FISHEYE_EQUIDISTANT', 'fisheye': 'FISHEYE_EQUIDISTANT', 'equirectangular': 'EQUIRECTANGULAR'}


def arguments():
    parser = argparse.ArgumentParser(prog='blender_show.py', description=__doc__.split('\n\n')[0])
    parser.add_argument('--states', required=True, help='of domefall states SHOW --format json')
    parser.add_argument('--frames', required=True, help='scene-linear frames, ##### for their numbers')
    parser.add_argument('--lens', help='lens maps of the same frames')
    parser.add_argument('--sky', help='the picture that is lensed')
    parser.add_argument('--out', help='what is composited, ##### for numbers')
    given = parser.parse_args(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    if bool(given.lens) != bool(given.sky):
        parser.error('--lens and --sky go together')
    return given


def numbered(pattern, number):
    return os.path.abspath(re.sub('#+', lambda signs: str(number).zfill(len(signs[0])), pattern))


def set_camera(scene, states):
    """Turns a camera as the states say. Blender's z is up: what is y there becomes z, and z becomes -y."""
    data = bpy.data.cameras.new('Domefall')
    camera = bpy.data.objects.new('Domefall', data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = 'CYCLES'
    upright = Matrix(((1, 0, 0), (0, 0, -1), (0, 1, 0)))
    camera.rotation_mode = 'QUATERNION'
    before = None
    for state in states:
        turn = (upright @ Matrix(state['world_from_camera'])).to_quaternion()
        if before:
            turn.make_compatible(before)
        before = camera.rotation_quaternion = turn
        camera.keyframe_insert('rotation_quaternion', frame=state['frame'])
        data['domefall_r'] = state['r'] or 0.0
    projection = states[0]['projection']
    view = math.radians(states[0]['fov_deg'])
    if projection == 'rectilinear':
        data.type = 'PERSP'
        data.sensor_fit = 'HORIZONTAL'
        data.angle = view
    elif projection in PANORAMAS:
        data.type = 'PANO'
        lens = data if hasattr(data, 'panorama_type') else data.cycles
        lens.panorama_type = PANORAMAS[projection]
        if projection != 'equirectangular':
            lens.fisheye_fov = view
    else:
        print(f'no camera of Blender makes a {projection} picture; frames are composited all the same')
    scene.frame_start, scene.frame_end = states[0]['frame'], states[-1]['frame']


class Compositor:
    def __init__(self, scene):
        scene.use_nodes = True
        self.tree = scene.node_tree
        self.tree.nodes.clear()

    def node(self, kind, **settings):
        node = self.tree.nodes.new('CompositorNode' + kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def link(self, source, target):
        self.tree.links.new(source, target)

    def pictures(self, pattern, first, count):
        """A node with all frames, whose outputs are the layers."""
        image = bpy.data.images.load(numbered(pattern, first))
        image.source = 'SEQUENCE'
        node = self.node('Image', image=image)
        node.frame_duration, node.frame_start, node.frame_offset = count, first, first - 1
        image.colorspace_settings.name = linear_space(image)
        return node

    def plus(self, one, other):
        node = self.node('MixRGB', blend_type='ADD')
        self.link(one, node.inputs[1])
        self.link(other, node.inputs[2])
        return node.outputs[0]

    def math(self, operation, *values):
        """A number of each pixel, of sockets or constants."""
        node = self.node('Math', operation=operation)
        for value, into in zip(values, node.inputs):
            if isinstance(value, float):
                into.default_value = value
            else:
                self.link(value, into)
        return node.outputs[0]

    def over(self, back, front):
        node = self.node('AlphaOver', use_premultiply=False)
        self.link(back, node.inputs[1])
        self.link(front, node.inputs[2])
        return node.outputs[0]


def linear_space(image):
    """Frames are linear; a compositor that knows ACEScg may be told so, and one that does not leaves them alone."""
    known = [item.identifier for item in
             image.colorspace_settings.bl_rna.properties['name'].enum_items]
    return next(name for name in ('Non-Color', 'Raw', 'Linear') if name in known)


def composite(compositor, frames):
    layers = {output.name: output for output in frames.outputs}
    below = [layers[name] for name in ('sky', 'stars', 'disc', 'bodies', 'glare') if name in layers]
    if not below:
        return frames.outputs[0]
    picture = below[0]
    for layer in below[1:]:
        picture = compositor.plus(picture, layer)
    return compositor.over(picture, layers['titles']) if 'titles' in layers else picture


def lensed(compositor, lens, sky):
    """A picture of the sky, at the place from which each pixel's light came.

    Blender cannot read the map's st.s and st.t, a layer of two channels, so they are formed of sky.x, sky.y and sky.z.
    """
    picture = compositor.node('Image', image=bpy.data.images.load(os.path.abspath(sky)))
    picture.image.colorspace_settings.name = linear_space(picture.image)
    direction = compositor.node('SeparateColor')
    compositor.link(next(output for output in lens.outputs if output.name == 'sky'), direction.inputs[0])
    x, y, z = direction.outputs[:3]
    math_of = compositor.math
    place = compositor.node('CombineXYZ')
    ascension = math_of('DIVIDE', math_of('ARCTAN2', y, x), 2 * math.pi)
    compositor.link(math_of('FRACT', math_of('SUBTRACT', 1.5, ascension)), place.inputs[0])
    declination = math_of('DIVIDE', math_of('ARCSINE', z), math.pi)
    compositor.link(math_of('ADD', declination, 0.5), place.inputs[1])
    # The third number is what is opaque: outside the picture directions have no length.
    squares = [math_of('MULTIPLY', part, part) for part in (x, y, z)]
    compositor.link(math_of('ADD', math_of('ADD', squares[0], squares[1]), squares[2]), place.inputs[2])
    warp = compositor.node('MapUV')
    compositor.link(picture.outputs[0], warp.inputs[0])
    compositor.link(place.outputs[0], warp.inputs[1])
    return warp.outputs[0]


def main():
    given = arguments()
    with open(given.states, encoding='utf-8') as file:
        states = json.load(file)
    scene = bpy.context.scene
    set_camera(scene, states)
    compositor = Compositor(scene)
    first, count = states[0]['frame'], len(states)
    frames = compositor.pictures(given.frames, first, count)
    scene.render.resolution_x, scene.render.resolution_y = states[0]['width'], states[0]['height']
    aspect = states[0]['pixel_aspect']
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = max(aspect, 1), max(1 / aspect, 1)
    scene.render.resolution_percentage = 100
    picture = composite(compositor, frames)
    if given.lens:
        picture = lensed(compositor, compositor.pictures(given.lens, first, count), given.sky)
    compositor.link(picture, compositor.node('Composite').inputs[0])
    compositor.link(picture, compositor.node('Viewer').inputs[0])
    if not given.out:
        return
    scene.render.image_settings.file_format = 'OPEN_EXR'
    scene.render.image_settings.color_depth = '32'
    # Only the compositor works: no scene is rendered.
    for layer in scene.view_layers:
        layer.use = False
    for state in states:
        scene.frame_set(state['frame'])
        scene.render.filepath = numbered(given.out, state['frame'])
        bpy.ops.render.render(write_still=True)


main()
