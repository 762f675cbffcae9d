# Runs a run's view.py in pvpython and looks at what it has set up: pvpython in_paraview.py RUN PICTURE
import runpy
import sys

run, picture = sys.argv[1:3]
sys.argv = ["view.py", picture]
made = runpy.run_path(run + "/view.py")

from paraview.simple import FindSource, GetAnimationScene, GetColorTransferFunction, GetDisplayProperties
from paraview.vtk.vtkIOImage import vtkPNGReader


def check(is_true, what):
    if not is_true:
        sys.exit("view.py: " + what)


parts, warp, clip = FindSource(made["PROBLEM"]), FindSource("deformed"), FindSource("clip")
interfaces = FindSource("deformed interfaces")
check(parts and warp and clip and interfaces, "a source is missing")
check(len(parts.TimestepValues) > 4, "frames are missing")
check(any(abs(made["TIME"] - t) < 1e-15 for t in parts.TimestepValues), "the instant shown is none of a frame")
check(made["TIME"] > 0, "the instant shown is not in the motion")
check(abs(GetAnimationScene().AnimationTime - made["TIME"]) < 1e-15, "ParaView stands at another instant")
check(warp.ScaleFactor > 1 and interfaces.ScaleFactor == warp.ScaleFactor, "nothing is magnified")
check(list(clip.ClipType.Origin) == made["CENTRE"], "the clip is not at the middle")
table = GetColorTransferFunction("von Mises stress (MPa)")
points = table.RGBPoints
values = made["values_of"](made["shown"], "von Mises stress (MPa)")
check(len(values) > 50 and abs(values[-1] / (1e-6 * made["TOP"]) - 1) < 0.5, "the stresses are not in MPa: %g" % values[-1])
low, top = points[0], points[-4]
check((low, top) == (made["low"], made["top"]), "the colours do not begin and end as they should: %g, %g" % (low, top))
is_logarithmic = table.UseLogScale == 1
check(is_logarithmic == (low > 0), "a logarithmic scale that begins at zero, or another that does not")
fifth = low * (top / low) ** 0.2 if is_logarithmic else 0.2 * top
check(sum(v > fifth for v in values) > 0.4 * len(values), "most of the assembly has the lowest colours")
names = GetColorTransferFunction("vtkBlockColors").Annotations
check(list(names) == ["0", "low", "1", "high"], "the parts are not named: %s" % names)
warp.UpdatePipeline(made["TIME"])
bounds = warp.GetDataInformation().GetBounds()
check(all(bounds[2 * d] <= made["CENTRE"][d] <= bounds[2 * d + 1] for d in range(3)), "the middle is outside")
shown = GetDisplayProperties(clip, made["view"]).Visibility + GetDisplayProperties(made["shown"], made["view"]).Visibility
check(shown == 1, "the whole and the clipped assembly are shown, or neither")

reader = vtkPNGReader()
reader.SetFileName(picture)
reader.Update()
image = reader.GetOutput()
width, height, _ = image.GetDimensions()
values = image.GetPointData().GetScalars()
colors = {values.GetTuple(i) for i in range(0, width * height, 7)}
check(width == 1920 and len(colors) > 50, "the picture is empty: %d colours" % len(colors))
print("view.py is as it should be")
