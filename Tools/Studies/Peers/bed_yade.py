# The bed of Dosta et al. (2024) for YADE:
#   GRAINS=FILE BOX="xlo xhi ylo yhi zlo" WARM=100 STEPS=500 yade -n -x -j1 bed_yade.py
# Prints: seconds, kinetic energy in J.
import math, os, time

def place(word):
    return float(os.environ['BOX'].split()[word])

material = O.materials.append(FrictMat(density=2500, young=1e9, poisson=0.2, frictionAngle=math.atan(0.3)))
with open(os.environ['GRAINS']) as rows:
    for r, x, y, z in (map(float, row.split()) for row in rows):
        O.bodies.append(sphere((x, y, z), r, material=material))
for axis, word, side in ((0, 0, 1), (0, 1, -1), (1, 2, 1), (1, 3, -1), (2, 4, 1)):
    O.bodies.append(wall(place(word), axis, sense=side, material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=1e-4),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.5)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.8)),
]
O.dt = 5e-7
O.run(int(os.environ['WARM']), True)
start = time.time()
O.run(int(os.environ['STEPS']), True)
print('result', time.time() - start, kineticEnergy())
