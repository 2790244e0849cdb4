"""Life over a duty cycle: a fan that idles, runs and meets gusts.

Each load case takes its share of the time, and another share of the damage.
"""

import matplotlib.pyplot as plt

import oilfilm

summary = oilfilm.run("6208_duty_cycle").summary
print(f"life {summary['duty_cycle']['modified_reference_rating_h']:.0f} h")
cases = summary["load_cases"]
names = ["runs", "gust", "idles", "stands"]
figure, axes = plt.subplots(figsize=(6.0, 3.0), layout="constrained")
left = [0.0, 0.0]
for name, case in zip(names, cases, strict=True):
    shares = [case["share"], case["damage_share"]]
    axes.barh(["of the time", "of the damage"], shares, left=left, label=name)
    left = [start + share for start, share in zip(left, shares, strict=True)]
axes.set(xlabel="share", xlim=(0.0, 1.0))
figure.legend(loc="outside upper center", ncols=4, frameon=False)
figure.savefig("duty_cycle.png")
