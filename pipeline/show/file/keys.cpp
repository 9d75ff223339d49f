#include "pipeline/show/file/keys.h"

namespace domefall {
namespace {

// One row a key, below the name of its table.
constexpr std::string_view kRows = R"(
## show
| `title` | one line of text | the file's name without `.yaml` |
| `frames_per_second` | 1 to 240 frames per second: also as a fraction such as 24000/1001; 23.98, 29.97 and the like stand for n 1000/1001 | [30] |
| `size` | for a dome `1k`, `2k`, `4k`, `8k` or 16 to 16384 pixels; for a flat picture `[width, height]`, each 16 to 16384; for others see [projections](#projections) | [`4k`], flat [`[1920, 1080]`] |
| `black_hole`, `wormhole`, `camera`, `effects`, `sky`, `stars`, `disc`, `halo`, `jet`, `bodies`, `exposure`, `glare`, `grade`, `dome`, `output` | sections, below | |
| `begins_year` | -1e6 to 1e6 years: the year in which the show begins, for [planets](#planets-sun-and-moon), bodies given by their [elements](#orbits-by-elements) and the [counter](#counters) `{year}` | |
| `cameras` | further cameras by name, [below](#cameras) | |
| `keyframes` | what changes during the show, [below](#keyframes) | |
| `titles` | texts on the dome, [below](#titles) | |
| `draw_titles` | `true` or `false`: whether the titles of the show and of its segments are drawn, [below](#a-show-without-its-titles) | [`true`] |
| `markers` | names for instants of the show, `{door_opens: 0:34}`, or for events, `{horizon: {r: 2}}`, or a file of OpenTimelineIO such as `cut.otio`, [below](#times-and-markers) | |
| `audio` | its sound: a file, or a list of files with one channel each, as [movies.md](movies.md#sound) says. Movies, deliveries and the preview have it, unless `--audio` names another | none |
| `fade_in_s`, `fade_out_s` | at least 0: seconds in which the show comes out of black at its start, and sinks to black at its end | [0] |
| `timeline` | the list of segments, below | required |
## marker
| `r` | 1e-6 to 1e9 M: the event is the first instant at which the observer is there | one of the two |
| `l` | -1e9 to 1e9 radii of the throat: the same in a wormhole, whose sides l tells apart | |
| `leg` | `inward` or `outward`: the first one at which r, or l, falls or grows there | the first of either |
## black_hole
| `mass_solar` | 0 to 1e13 solar masses; 0 is flat space: from 1e-20 on, or 0 for no hole | [0] |
| `charge` | 0 to 100: its electric charge in units of its mass, [below](#a-charged-hole); above 1 with | [0] |
| `spin` | 0 to 0.999999: its angular momentum in units of its mass squared, [below](#a-hole-that-spins) | [0] |
| `axis` | the end of its axis from which it is seen to turn counter-clockwise: a [place on the sky](#places-on-the-sky) | the north of the first orbit |
| `naked` | `true` or `false`: whether a charge above 1 is meant, which no horizon hides | [`false`] |
| `at` | where the hole stands on the sky at the start: a [place on the sky](#places-on-the-sky) | [266.405, -28.936: the galactic centre] |
| `heading_deg` | -360 to 360: in which direction orbits set out, from north through east | [90] |
## wormhole
| `radius_km` | above 0, at most 1e15 km: of its throat, which is the unit of all lengths near it, and with the speed of light that of times | required |
| `profile` | `dngr` or `ellis`: a cylinder that widens like a hole of some mass, or r² = l² + 1 | [`dngr`] |
| `length` | 0 to 1e6 radii of the throat: of the cylinder of `dngr` | [0.01] |
| `lensing_width` | 1e-6 to 1e6 radii of the throat: how far around the mouths of `dngr` the sky is bent | [0.05] |
| `at` | where it stands on the sky at the start: a [place on the sky](#places-on-the-sky) | [266.405, -28.936: the galactic centre] |
| `heading_deg` | -360 to 360: in which direction orbits set out, from north through east | [90] |
## place
| `ra_deg` | 0 to 360: right ascension (J2000) in decimal degrees | these two or |
| `dec_deg` | -90 to 90: declination | |
| `star` | the name of a place, as it may stand in the place of the map | this |
## timeline
| `duration_s` | above 0, at most 1e7: seconds of show, or `0:34`; or the [marker](#times-and-markers) at which the segment ends | required |
| `trajectory` | how the observer moves, below | required; at rest in flat space |
| `fade_in_s`, `fade_out_s` | at least 0: seconds in which the segment comes out of black, and sinks to it | [0] |
| `dissolve_s` | at least 0: a cross-dissolve: the segment's first seconds lie over the last ones of the segment before, and both are seen, the one fading into the other. At most as long as either | [0]: a cut |
| `camera` | keys of `camera` that differ in this segment, or the name of one of the `cameras` | the show's camera |
| `exposure`, `grade`, `sky`, `disc`, `bodies`, `title_light` | what differs in this segment: `exposure: {ev}`, `grade: {cdl}`, `disc: {luminance_cd_m2, opacity}`, `bodies: {NAME: {magnitude}}`, `title_light: {gain, opacity}`, `sky: {region_I: {background, white_cd_m2, black_cd_m2, gain, stars: {max_magnitude, gain}}, region_III: the same, region_IV: {background, white_cd_m2, black_cd_m2, period_m, gain}}`. A background that a segment names has its own white and black; what else a segment does not name is the show's; its `region_III` does not follow its `region_I` | the show's |
| `keyframes` | what changes during the segment, [below](#keyframes) | |
| `titles` | texts that are seen in this segment, [below](#titles) | |
## trajectory
| `type` | one of the types below | required |
## region
| `region` | `I` or `III`: the universe in which it happens | [`I`] |
## begin
| `from_r` | 1e-6 to 1e9: where the segment begins | |
| `from_leg` | `inward` or `outward`: on which leg `from_r` lies | [`inward`] |
| `from_tau_m` | -1e15 to 1e15: the beginning by proper time; r must be from 1e-6 to 1e9 there | |
## end
| `to_r` | 1e-6 to 1e9: where the segment ends: the first place behind the beginning with this r, on either leg unless one is named | |
| `to_leg` | `inward` or `outward`: on which leg `to_r` lies | |
| `to_tau_m` | -1e15 to 1e15: the end by proper time, likewise | |
## rates
| `rate_m_per_s` | 0 to 1e12 units of M per second of show: of the observer's proper time, instead of an end; `[2, 0.5]` changes the rate smoothly from the segment's beginning to its end, so that segments whose rates meet join without a jerk. Two rates can be given with an end too, [below](#both-speeds-and-the-end) | [1] |
| `time_lapse` | 0 to 1e12 real seconds per second of show: the same | |
## pace
| `pace` | `steady`, `eased`, `eased_in`, `eased_out`, `slowing`, `quickening`, `log_r` or `frozen`: `eased` goes from standing still to standing still, `eased_in` and `eased_out` do so at one end only; with `slowing`, before the singularity, the time left falls by equal factors in equal times, and `quickening` is the same backwards, after the past one; with `log_r` r changes by equal factors in equal times, inside or outside, where it only falls or only rises; `frozen` is time that stands still | [`steady`] |
## parabolic
| `periastron` | 1e-6 to 1e9 M: its smallest r, which exceeds 4; or | |
| `angular_momentum` | 0 to 1e9 M: more than 4; or | |
| `excess` | 1e-20 to 1e9: of the angular momentum over 4 M, as a part of it: 1e-10 is L = 4 (1 + 1e-10), which circles long at r = 4 before it comes back | |
## hyperbolic
| `v_inf` | above 0, below 1 speed of light = 1: the speed at infinity, 1e-9 to below 1 - 1e-12 | |
| `periastron` | 1e-6 to 1e9 M: its smallest r, which exceeds 3. Below 4 only a speed of more than sqrt(4 - r)/(r - 2) brings it back; or | |
| `impact_parameter` | 0 to 1e9 M: how far it would pass by without gravity; or | |
| `excess` | 1e-20 to 1e9: with `periastron` instead of `v_inf`: by which part the speed lies above that slowest one; with `v_inf` alone: by which part the impact parameter lies above that of capture | |
## bound
| `periastron`, `apoastron` | 1e-6 to 1e9 M: its smallest and its largest r; or | |
| `eccentricity` | 0 to below 1: e of r = p/(1 + e cos x), with | |
| `semilatus_rectum` | 1e-6 to 1e9 M: p, more than 6 + 2e; or with | |
| `excess` | 1e-20 to 1e9: p - 6 - 2e: the closest orbits circle many times at each periastron | |
## infall
| `from_r` | above 0, at most 1e9: where the segment begins | required; with `rest_r` that |
| `to_r` | 1e-6 to 1e9: where it ends, below `from_r` | [0.05] |
| `rest_r` | above 2, at most 1e9: from rest at this r | |
| `angular_momentum` | 0 to 1e9 M: of a fall from infinity below 4 M, of one from `rest_r` less than would keep it there | [0] |
| `v_inf` | above 0, below 1 speed of light = 1: from infinity with this speed, and | |
| `impact_parameter` | 0 to 1e9 M: how far it would pass by without gravity; small enough to be captured | |
## circular
| `r` | above 3, at most 1e9: of the orbit | required |
| `orbits` | 0 to 1e6 revolutions: how many orbits in the segment | |
## thrown
| `from_r` | 1e-6 to 1e9: where it is thrown | required |
## kruskal
| `energy` | 0 to 1e6: per unit of mass. 0: from IV to II through the throat itself, at r = 2. From 1e-6 to below 1: out into region I, to rest at r = 2/(1 - energy²) if it has no angular momentum, and back into II. 1 and more: out to infinity, or, with much angular momentum, around and back into II | [1] |
| `angular_momentum` | 0 to 1e9 M: around the hole | [0] |
## body
| `body` | the name of the body | required |
| `behind_m` | -1e9 to 1e9: follows it on the same way, so many M of v later; ahead of it if negative | [0] |
## path
| `keyframes` | a list of places and times, with the keys below | this or |
| `file` | a CSV file with the columns `proper_time`, `r` and perhaps `azimuth_deg`, `tetrad`, `celerity_r`, `celerity_phi` as `domefall states` writes them | this |
## path.keyframes
| `at_m` | -1e12 to 1e12: the observer's own time | required |
| `r` | 1e-6 to 1e9: where it is then | required |
| `azimuth_deg` | -1e9 to 1e9: where it is then | [0] |
## spiral
| `from_r` | above 3, at most 1e9: of the circular orbit on which it begins | required |
| `turns` | 0.5 to 1000 revolutions: from the beginning to the horizon | [3] |
## braked
| `from_r` | above 2, at most 1e9: where it begins to brake | required |
| `stop_r` | above 2, at most 1e9: where it comes to rest, and hovers from then on | required |
| `speed` | 1e-6 to below 1 speed of light = 1: at `from_r`, against what is at rest there | sqrt(2/`from_r`), that of a fall from rest far away |
## static in a wormhole
| `l` | -1e9 to 1e9 radii of the throat: the distance from the middle of the throat, negative beyond it | required |
## circular in a wormhole
| `l` | -1e9 to 1e9 radii of the throat: where it circles, by engines | required |
| `speed` | above 0, below 1 speed of light = 1: against what is at rest | required |
| `orbits` | 0 to 1e6 revolutions: how many orbits in the segment | |
## infall in a wormhole
| `from_l` | -1e9 to 1e9 radii of the throat: where the segment begins | required |
| `speed` | above 0, below 1 speed of light = 1: of the free fall, everywhere | required |
| `impact_parameter` | 0 to 1e9 radii of the throat: below 1 it passes the throat, above it turns where r is that | [0] |
## thrown in a wormhole
| `from_l` | -1e9 to 1e9 radii of the throat: where it is thrown | required |
## end in a wormhole
| `to_l` | -1e9 to 1e9: where it ends, beyond the throat if it has the other sign | |
| `to_tau_m` | -1e15 to 1e15: the end by proper time | |
## static about a spin
| `r` | above 0, at most 1e9 M: outside the ergosphere, or outside the horizon with | required |
| `dragged` | `true` or `false`: whether it turns with space, without angular momentum, and does not rest against the stars | [`false`] |
| `latitude_deg` | -90 to 90: above the hole's equator | [0] |
## circular about a spin
| `r` | above 1, at most 1e9 M: of a free orbit in the equator, or outside the horizon with a `speed` | required |
| `retrograde` | `true` or `false`: whether it goes against the spin | [`false`] |
| `speed` | above -1, below 1 speed of light = 1: instead, by engines, against who turns with space; against the spin if negative | |
| `latitude_deg` | -90 to 90: above the hole's equator, of a circle with a `speed` | [0] |
| `orbits` | 0 to 1e6 revolutions: how many orbits in the segment, as the stars see them | |
## infall about a spin
| `rest_r` | above 1, at most 1e9 M: from where it neither rises nor falls at this r; else from far away | |
| `latitude_deg` | -90 to 90: above the hole's equator, where the fall begins | [0] |
| `angular_momentum` | -1e3 to 1e3 M: about the axis; the fall must not turn around | [0] |
## bound about a spin
| `periastron` | above 1, at most 1e9 M: its smallest r | required |
| `apoastron` | above 1, at most 1e6 M: its largest r; if both are alike, it stays on a sphere | required |
| `inclination_deg` | 0 to 180: how far from the equator it goes; beyond 90 it goes against the spin, and at 90 over both ends of the axis | [0] |
## thrown about a spin
| `from_r` | above 1, at most 1e9 M: where it is thrown | required |
| `latitude_deg` | -90 to 90: above the hole's equator | [0] |
## path about a spin
| `keyframes` | a list of places and times, with the keys below | this or |
| `file` | a CSV file with the columns `proper_time`, `r` and perhaps `latitude_deg`, `azimuth_deg`, `celerity_r`, `celerity_theta`, `celerity_phi` as `domefall states` writes them | this |
## keyframes about a spin
| `at_m` | -1e12 to 1e12: the observer's own time | required |
| `r` | above 0, at most 1e9 M: where it is then, outside the inner horizon | required |
| `latitude_deg` | -90 to 90: above the hole's equator | [0] |
| `azimuth_deg` | -1e9 to 1e9: about the axis, with the spin | [0] |
## velocity about a spin
| `r` | above 0, at most 1e9 M: outside the horizon, or down to the inner one with `against: free_fall` | required |
| `latitude_deg` | -90 to 90: above the hole's equator | [0] |
| `against` | `dragged`, `static` or `free_fall`: the observer against whom the speed is measured: who turns with space, without angular momentum; who rests against the stars, outside the ergosphere; or who falls from rest far away | [`dragged`] |
## path in a wormhole
| `keyframes` | a list of places and times, with the keys below | this or |
| `file` | a CSV file with the columns `proper_time`, `l` and perhaps `azimuth_deg`, `celerity_r`, `celerity_phi` as `domefall states` writes them | this |
## keyframes in a wormhole
| `at_m` | -1e12 to 1e12 radii of the throat: the observer's own time | required |
| `l` | -1e9 to 1e9: where it is then | required |
| `azimuth_deg` | -1e9 to 1e9: where it is then | [0] |
## static
| `r` | above 2, at most 1e9: near a hole; not allowed in flat space | required |
## speed
| `speed` | 0 to below 1 speed of light = 1: or two of them, `[0, 0.9]`: the rapidity changes evenly, as under constant acceleration | this or |
| `lorentz_factor` | 1 to 1e9: or two of them | this is required |
| `direction` | `inward`, `outward`, `forward`, `backward` (along an orbit), `north`, `south` (across it); `{radial, theta, phi}`; or a place on the sky | required unless the speed is 0 |
## direction
| `radial`, `theta`, `phi` | -1e9 to 1e9: components of a `direction`, of any length but 0 | [0] |
## velocity
| `r` | above 2, at most 1e9: with another `against` than `static` from 1e-6. Not in flat space | required near a hole |
## against
| `region` | `I`, `II`, `III` or `IV`: the outside, inside the black hole, the other outside, or the white hole, before the past horizon | `I` outside; inside, where `against` is found |
| `against` | `static`, `free_fall`, `outgoing` or `constant_t`: the observer against whom the speed is measured: at rest (I and III), falling in (I, II and III), thrown out, to rest far away (I, III and IV), or at rest in t, midway between both outsides (II and IV) | [`static`] |
## camera
| `projection` | `domemaster`, `fisheye`, `equirectangular`, `cubemap`, `stereographic` or `rectilinear`: [below](#projections) | [`domemaster`] |
| `cut` | `back`, `front` or `both`: of fisheyes lower than wide, where rows are missing | [`back`] |
| `fov_deg` | flat pictures: horizontal angle of view, between 0 and 360, rectilinear ones at most 170; fisheyes: angle across the circle, up to 360 | [90], fisheye [180] |
| `look_at` | the target: `hole`, `outward` (away from it), `motion`, a place on the sky, or a map of one of the keys below | [`hole`] |
| `euler_deg` | -3600 to 3600: `[phi, theta, psi]`, instead of `look_at`, `roll_deg` and `elevation_deg` | |
| `file` | a `.chan` or `.usda` file with a camera that another program has animated, instead of these and `elevation_deg`: [compositing.md](compositing.md#the-camera) says how it is turned; its frame 0 is the show's | |
| `roll_deg` | -3600 to 3600: turns the scene clockwise about the target | |
| `frame` | `hole`, `gyroscope` or `stars`: it follows its target (`hole`); or it is turned to the target where the motion begins, and from there on keeps its direction as a gyroscope does that the observer carries, or against the far stars, [below](#cameras-that-keep-their-direction) | [`hole`] |
| `elevation_deg` | -90 to 90: on domes, and pictures of the whole sphere, height of the target above the front of the rim, or of the horizon | [45] |
| `dome_tilt_deg` | -90 to 90: how far such a dome leans to the front; is added to the elevation | [0] |
## look_at
| `keyframe` | the name of an earlier keyframe: what it looks at | |
| `body` | the name of one of the show's [bodies](#bodies): its direct image, or the hole where there is none | |
## keyframes
| `at_s` | at least 0: a [time](#times-and-markers) since the start of the show, or of the segment, or a marker | required |
| `camera` | its keys as above, without `projection` and `cut`, or the name of one of the `cameras` | |
| `exposure`, `grade`, `sky`, `disc`, `bodies`, `title_light` | as in a segment, without backgrounds | |
| `ease` | `smooth`, `linear`, `hold`, `eased`, `eased_in` or `eased_out`: how the values of this keyframe are reached from the keyframe before that gives them; `hold` keeps the old values until this keyframe; `eased` goes from standing still to standing still, where `smooth` passes keyframes between others without a stop, and `eased_in` and `eased_out` stand still at their beginning and at their end only | [`smooth`] |
| `name` | a name by which later keyframes look at the same target: `look_at: {keyframe: NAME}` | |
## titles
| `text` | up to 2,000 bytes in any script that the machine has fonts for; several lines in a block after `|`; [counters](#counters) in braces | required |
| `at_s` | at least 0: a [time](#times-and-markers) since the start of the show, or of the segment, or a marker | [0] |
| `duration_s` | above 0: seconds, or the marker at which the title goes | [to the end of the show, or of the segment] |
| `fade_in_s`, `fade_out_s` | at least 0: seconds, of the duration, in which it comes and goes | [0] |
| `azimuth_deg` | -360 to 360: where its middle is, to the right of the audience's front: 90 is at the right hand, 180 behind | [0] |
| `elevation_deg` | -90 to 90: above the audience's horizon; on a flat picture above its middle | [30], flat [0] |
| `place` | a [place on the sky](#places-on-the-sky): the title stands below its image, wherever that is seen | |
| `body` | the name of one of the show's [bodies](#bodies): the title stands below its direct image and goes with it | |
| `figure` | a constellation, in Latin or by its abbreviation: its lines are drawn on the sky, and the text stands at their middle or at `place` | |
| `height_deg` | above 0, at most 60: of a capital letter | [2] |
| `font` | a family and perhaps a style: `DejaVu Serif Bold Italic` | [`Sans`] |
| `align` | `left`, `centre` or `right`: of lines of different lengths | [`centre`] |
| `colour` | 0 to 1: `[red, green, blue]`, linear light with the primaries of Rec.709 | [[1, 1, 1]] |
| `brightness` | 0 to 10000 pixel values: of its white | [1] |
| `shadow` | 0 to 1: the part of the light that is taken away behind the letters and, softly, close around them | [0] |
| `plate` | 0 to 1: the part of the light that is taken away behind the whole text, with soft edges | [0] |
## title_light
| `gain` | 0 to 6: a factor on the `brightness` of all titles that are seen then | [1] |
| `opacity` | 0 to 1: a factor on how much they cover, with their plates and shadows; at 0 they are not there | [1] |
## sky
| `region_I` | the sky outside, with the keys below | |
| `region_III` | the other sky, with the same keys | like `region_I` |
| `next` | near a charge: the sky of the [next universe](#through-a-charged-hole), with the same keys | like `region_I` |
| `region_IV` | the past singularity: a `background` seen as a sphere, or `rings`, or a map of the keys below. No stars, no redshift | [`black`] |
## sky.law
| `blueshift_power` | 0 to 10: a panorama grows brighter by (1 + z) to minus this power where its light is shifted to the blue | [2] |
| `epoch` | -10000 to 30000 Julian years: stars with a proper motion stand where they stand then, such as 2026.5 | [2000]: as catalogued |
| `planets` | `true` or `false`: whether Mercury to Neptune are drawn among the stars of `region_I`, as bright as they are at `begins_year` and [in their places](#planets-sun-and-moon) | [`false`] |
## sky.gain
| `gain` | 0 to 1e6: a factor on the background; 1 is physical | [1] |
## sky.stars
| `stars` | `none`, `standard`, `naked_eye`, `deepest`, a catalogue file, or `{catalogue, max_magnitude, gain}` | [`standard`] |
## sky.background
| `background` | `milky_way`, `grid` (5-degree squares), `black`, a `.sky` file, or an image: equirectangular, equatorial, right ascension 0 in the middle and growing to the left | [`milky_way`] |
| `white_cd_m2` | above 0, at most 1e12 cd/m^2: of an image, the luminance of its white | [1e-3], which is pixel value 1 at 0 EV |
| `black_cd_m2` | 0 to 1e6 cd/m^2, or auto, or none: what is black on a map; `auto` is the map's own darkest 1 % | [`auto`] |
## sky.rings
| `period_m` | 1e-3 to 1e9: of `rings` in region IV, from one to the next | [4] |
## sky.catalogue
| `catalogue` | `standard` (131,085 stars to V = 9), `naked_eye` (those of them to 6.5), `deepest`, a `.stars` file or a CSV file | [`standard`] |
## sky.light
| `max_magnitude` | -30 to 40 magnitudes: the faintest stars taken | [all of a `.stars` file; `naked_eye` 6.5; a CSV 9] |
| `gain` | 0 to 1e6: a factor on their light; 1 is physical | [0.4], with `stars: {law: size}` 1 |
## effects
| `aberration` | `true` or `false`: with `false` everything stands where an observer at rest at the same place sees it | [`true`] |
| `doppler_colour` | `true` or `false`: with `false` light keeps the colour that it has at rest | [`true`] |
| `intensity` | `true` or `false`: with `false` a shift of frequency changes colours only; the bolometric intensity stays | [`true`] |
| `lensing` | `true` or `false`: with `false` light comes in straight lines, as if the hole were not there; no silhouette. Outside the horizon only: a show with a frame at r = 2 or below is refused | [`true`] |
| `amplification` | `stars`, `none` or `everything`: what grows brighter as it is magnified: point sources only, as in nature; not even these; or backgrounds too, to show where there is magnification and how much | [`stars`] |
## stars
| `law` | `size` or `psf`: with `psf` all stars are alike, as a lens draws them: a point that is the brighter the more light it has, and a glow around bright ones; `size` is the paper's: the brighter a star, the larger its blob | [`psf`], but `size` where a key of `size` is given |
| `min_sigma_deg` | above 0, at most 10: width (sigma) of every star's middle, with `size` of a faint star's blob; never below 0.9 pixel | [0.04] |
| `growth` | 0 to 0.5: how fast bright stars grow; 0 not at all, 0.5 so that all are equally bright at their centre (`size`) | [0.2] |
| `reference_magnitude` | -30 to 40 magnitudes: brighter stars than this grow (`size`) | [5] |
| `max_sigma_deg` | above 0, at most 10: widest blob, from `min_sigma_deg` on (`size`) | [0.3] or `min_sigma_deg` if that is larger |
| `halo` | above 0, at most 0.9: the part of its light that a bright star has in its glow (`psf`) | [0.12] |
| `halo_sigma_deg` | above 0, at most 3: width of the glow's inner half; three tenths of its light reach 2.5 times as far, two tenths 6 times (`psf`) | [0.08] |
| `white_core` | 0 to 1e6: pixel value at which the colour of a blob is half way to white; 0: never | [0], with `size` 10 |
| `saturation` | 0 to 2: how far colours are from grey; 1 is the colour that the CIE's observer sees of a blackbody | [0.8], with `size` 1 |
| `least_radius_deg` | above 0, at most 1: the angular radius that every star has at least, below | [0.005] |
## disc
| `inner_r` | 6 to 1e6: where it ends inside, with `plunging: true` from 2 on; with a charge or a spin from its last stable orbit and its horizon on | [6, the last stable orbit; with `plunging` 2, the horizon] |
| `outer_r` | above 2, at most 1e6: where it ends outside, above `inner_r` | [20] |
| `inclination_deg` | 0 to 180: the angle between its plane and that of the orbits that set out as `heading_deg` says; with more than 90 it turns against them | [10] |
| `node_deg` | -360 to 360: where its gas rises through the plane of the orbits to their north, as an azimuth from the observer's first place in the sense of the orbits | [90] |
| `retrograde` | `true` or `false`: whether it goes against a hole that spins | [`false`] |
| `t_max_k` | 1000 to 1e9: the temperature of its hottest ring; gold at 3000, like the Sun at 6000, blue at 20000 | [3000; about a spin more, 5100 at 0.9] |
| `optical_depth` | above 0, at most 1e6: through the gas at right angles; with less than 1 stars shine through, and along its plane all gas is opaque | [6] |
| `rim` | 0 to 0.5 of its radius: over which it thins out at its inner and outer end, each at most over half of its width | [0.2] |
| `height` | 0 to 0.5: H/r of its section, a Gaussian, at `outer_r`; it falls inwards as the eighth root of r; 0 of a sheet, else at least 0.01 | [0] |
| `plunging` | `true` or `false`: whether gas falls in from the last stable orbit and shines on its way | [`false`] |
| `pattern` | `turbulence`, `rings`, `spot` or `none`: or a map with one of these as `type` and the keys below, or a list of them | [`none`] |
| `slow_light` | `true` or `false`: whether a pattern is seen as it was when the light left it; with `false` all of it is seen at one time | [`true`] |
## disc.light
| `luminance_cd_m2` | above 0, at most 1e12 cd/m^2: how bright that ring is to an observer who moves with it | [1e-2, which is pixel value 10 at 0 EV; about a spin more, 5.9e-2 at 0.9] |
| `opacity` | 0 to 1: the part of the light from behind it that it takes away; its own light is the same part of what it would be | [1] |
## pattern
| `type` | `turbulence`, `rings`, `spot`, `file` or `none`: a pattern with the keys below; `file` where a `file` is named | required |
## turbulence
| `contrast` | 0 to 1: with 1 the gaps go dark | [1] |
| `orbits` | 0.5 to 20 orbits: of its place, as long as a filament lives: the longer, the more is it wound up | [1] |
| `seed` | 0 to 1e9: a whole number; another one is another pattern of the same kind | [1] |
## rings
| `spacing_r` | 0.01 to 1000: from one ring to the next | [2] |
| `contrast` | 0 to 1: with 1 the gaps go dark | [0.8] |
| `inward_speed` | 0 to 0.5 parts of the speed of light: how fast they drift inwards | [0.02] |
## spot
| `r` | 6 to 1e6: the radius of its orbit; with a charge or a spin from the last stable one on; within the disc | [8, or that] |
| `azimuth_deg` | -360 to 360: where it is at t = 0, in its orbit's sense from where the gas rises through the plane of the observer's orbits | [0] |
| `size_r` | 0.01 to 10: the standard deviation of its brightness | [0.7] |
| `brightness` | 1 to 1e4 times the gas beside it: of its middle | [5] |
## pattern.file
| `file` | a picture: its columns are azimuths from where the gas rises through the plane of the observer's orbits, in its sense, its rows radii from `inner_r` at the bottom to `outer_r` at the top | required |
| `at_m` | -1e9 to 1e9: the t at which it looks as painted; before and after the gas has carried it along | [0] |
## halo
| `r` | 1 to 1e4: its density falls as exp(-(r/`r`)²/2) | [4] |
| `height` | 0.02 to 2: its density falls as exp(-(s/`height`)²/2) with the sine s of the latitude | [0.3] |
| `luminance_cd_m2` | above 0, at most 1e12 cd/m^2: of so many M of its densest gas as `r` says, to whoever moves with it | [2e-3] |
| `t_k` | 500 to 1e9: the temperature whose colour and changes of colour its light has | grey |
| `inclination_deg` | 0 to 180: of its equator, as of a disc | [10, or the disc's] |
| `node_deg` | -360 to 360: likewise | [90, or the disc's] |
## jet
| `lorentz_factor` | 1 to 1000: of the flow against whoever rests there | [3] |
| `opening_deg` | 1 to 45: its density falls as a Gaussian of the angle from its axis, with this standard deviation | [6] |
| `r` | 3 to 1e4: where it is densest; from there on it thins out as the square of r | [6] |
| `length_r` | 3 to 1e4: where it ends, as a Gaussian of r | [60] |
| `luminance_cd_m2` | above 0, at most 1e12 cd/m^2: of so many M of gas at `r` as `r` says, to whoever moves with it | [5e-3] |
| `t_k` | 500 to 1e9: the temperature whose colour and changes of colour its light has | grey |
| `inclination_deg` | 0 to 180: of its equator, as of a disc | [10, or the disc's] |
| `node_deg` | -360 to 360: likewise | [90, or the disc's] |
## bodies
| `r` | above 3, at most 1e9: radius of its circular orbit; near a charge above its light circle | one of the three |
| `trajectory` | how it moves otherwise: of type `static`, `circular`, `parabolic`, `hyperbolic`, `bound`, `infall` or `thrown`, by the keys of [timeline](#timeline) that say what it is and where it begins; none that says where a segment ends or how its clock runs | |
| `elements` | its orbit as astronomers publish it, [below](#orbits-by-elements) | |
| `begins_m` | -1e9 to 1e9: its v = t + r\*, counted from the show's start, when it is where `trajectory` begins; before that it does not shine. The observer's v is the `null_time` of `domefall states` | it begins with the show, and has come that way before |
| `inclination_deg` | 0 to 180: angle of its orbit's plane to that of the first orbit; beyond 90 it goes the other way | [0] |
| `node_deg` | -360 to 360: azimuth, from the observer's first place, at which it rises to the north of that plane | [0] |
| `azimuth_deg` | -3600 to 3600: its azimuth from the node where it begins: at the instant that light falling straight in shares with the show's start (its v = 0), or at `begins_m` | [0] |
| `temperature_k` | 100 to 1e9: colour of its light, a blackbody's | [6000] |
| `absolute_magnitude` | -100 to 100 magnitudes: instead, that at 10 pc, as catalogues have it | |
| `radius` | above 0, at most 1e6 M: of a glowing sphere. Its disc has the light of the `magnitude` and is darker towards the limb. The sphere must stay clear of the horizon on its orbit; if the body falls in, where its fall begins | [a point] |
| `texture` | an equirectangular image of its surface, as any that [sky](#sky) takes: north is that of its orbit, the middle column faces the node, east is on the right. Its mean is as bright as a sphere without it, and white has the colour of `temperature_k` | [none] |
| `granulation` | 0 to 1: the contrast of the granules of a star, a sphere without `texture` and `lit_from`, as a standard deviation; 0 for an even surface | [0.12, above 8000 K 0] |
| `lit_from` | what lights it, if it does not shine itself: a place on the sky, `{ra_deg: X, dec_deg: Y}` or a name, the name of another body, or `disc`, for light from about the hole; its `magnitude` is then that of its full phase | [it shines itself] |
| `tilt_deg` | -180 to 180: how far its own axis, the north of `texture` and `rings`, leans from that of its orbit towards the node | [0] |
| `rings` | flat rings about its equator: a map with the keys [below](#rings-of-bodies), or a list of such maps, from the inmost ring on | [none] |
## ring
| `inner` | 1 to 100 of the body's radii: where it begins | required |
| `outer` | 1 to 100 of the body's radii: where it ends | required |
| `opacity` | 0 to 1: the part of light from behind that it takes away where it is seen face-on | [0.7] |
| `colour` | 0 to 1: `[red, green, blue]`, linear light with the primaries of Rec.709 | [[1, 1, 1]] |
## body.light
| `magnitude` | -100 to 100 magnitudes: visual magnitude that it would have at a distance of 100 M, at rest and without the hole | [0] |
## elements
| `period_years` | above 0, at most 1e9 years: Julian, of the ellipse | required |
| `eccentricity` | 0 to below 1: of the ellipse | required |
| `inclination_deg` | 0 to 180: of its plane to that of the sky; below 90 it goes counter-clockwise there | required |
| `node_deg` | -360 to 360: position angle, from north through east, of the node at which it recedes | required |
| `pericentre_deg` | -360 to 360: from the node to the pericentre, in the sense of its motion | required |
| `pericentre_year` | -1e6 to 1e6 years: of the hole's light, v, as the show's `begins_year` | required |
## exposure
| `ev` | -30 to 30 stops: +1 doubles the light | [0] |
## glare
| `share` | 0 to 0.9: the part of all light that is spread around; 0 for none | [0.12 with a disc, a halo, a jet or bodies that have a radius, else 0] |
| `width_deg` | 0.3 to 5: the standard deviation of the narrowest part; the others are 4, 15 and 50 times as wide | [0.5] |
## shutter
| `disc` | above 0, at most 65504: instead of `ev`, that at which the disc's hottest ring has this pixel value for whoever moves with it | |
| `shutter_deg` | 0 to 360: how long the shutter is open, as a film camera's: 180 is half the time from one frame to the next, 360 all of it; 0 is the instant alone | [0] |
## grade
| `config` | an OpenColorIO configuration | the one that Domefall ships |
| `display`, `view` | names from that configuration; [grading.md](grading.md) describes the shipped ones and how to choose | its defaults |
## grade.cdl
| `cdl` | ASC CDL, applied before the view in ACEScct, a logarithmic space, where slope is contrast and a little offset is exposure; the keys below, each but the last one number or `[red, green, blue]` | leaves the picture as it is |
## cdl
| `slope` | 0 to 1e6: a factor | [1] |
| `offset` | -1e6 to 1e6: what is added | [0] |
| `power` | above 0, at most 100: an exponent | [1] |
| `saturation` | 0 to 100: 0 is grey | [1] |
## dome
| `light` | `none`, `simulate` or `compensate`: what is done about the light that a dome throws upon itself: `simulate` is for graded frames that look on a screen as the show will in the dome, `compensate` for frames that look in the dome as the show does on a screen. For the projection `domemaster` only; it acts on graded frames and previews, not on the scene-linear ones | [`none`] |
| `reflectance` | 0 to 1: the part of light that the dome's surface reflects | [0.45] |
## output
| `linear` | `half`, `float` or `none`: scene-linear OpenEXR, of 16-bit floats or of 32 bits, twice the size, for compositing: bright stars beyond 65504 keep their light and dim ones their digits. A change from one to the other makes all frames again | [`half`] |
| `pixel_aspect` | 0.5 to 2: the width of a pixel over its height, of flat pictures and fisheyes, or a ratio such as `16:11`, [below](#pixels-that-are-not-square) | [1] |
| `layers` | a list of any of `sky`, `stars`, `disc`, `bodies`, `glare` and `titles`: these parts of the light, too, in the scene-linear files, as [compositing.md](compositing.md) says | none |
| `layer_files` | `true` or `false`: whether each layer has a file of its own, `layers/disc/NAME_00000.exr`, with channels `R`, `G`, `B` and, where it has one, `A` | [`false`] |
| `data` | a list of any of `lens`, `mattes` and `cryptomatte`: numbers about each pixel, as channels of 32 bits in the scene-linear files, as [compositing.md](compositing.md) says | none |
| `compression` | `zip`, `zips`, `piz` or `none`: of the scene-linear files, all without loss: blocks of 16 rows, single rows, or wavelets, which are smaller for noise and three times slower to read | [`zip`] |
| `graded` | `png16`, `png8`, `jpeg`, `tiff16`, `tiff8`, `png`, `tiff` or `none`: display-ready files; those without a number have 16 bits | [`png16`] |
| `graded_alpha` | `true` or `false`: whether PNG and TIFF have an alpha, white where the projection shows anything, as inside a dome's circle, and 0 elsewhere | [`false`] |
| `quality` | 1 to 100: of a JPEG | [95] |
| `name` | what the files are called before `_00000`, up to 200 bytes | the show's file name |
| `start` | 0 to 1e9: the number of frame 0 | [0] |
| `digits` | 1 to 10: filled up with zeros; a larger number has more | [5] |
| `per_folder` | 1 to 10000: so many frames share a folder, `graded/NAME_00000-09999/NAME_00000.png` | all are in one |
| `owner` | whose the pictures are, as the attribute `owner` of scene-linear files; frames that are there keep theirs | nothing |
)";

}  // namespace

std::string_view rows_of_keys() { return kRows; }

}  // namespace domefall
