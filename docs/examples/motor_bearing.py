"""A motor bearing by its designation: 6205-2RS C3 at 3000 r/min and 500 N.

Everything that the designation does not say is estimated, with its range; the messages say what.
"""

import oilfilm

result = oilfilm.run("6205-2RS C3", speed_rpm=3000, radial_N=500)
print(result)
for note in result.messages[:3]:
    print("-", note)
result.plot("load_zone").savefig("motor_bearing.png")
