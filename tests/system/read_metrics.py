# Reads a page of metrics with the parsers of prometheus_client and writes what they made of it, one
# JSON object a sample.  A page that they refuse ends the program, and so does one with a family or a
# sample that stands there twice.
#   read_metrics.py openmetrics|prometheus FILE
import json
import sys

from prometheus_client import openmetrics
from prometheus_client import parser as prometheus
import prometheus_client.openmetrics.parser

form, path = sys.argv[1:]
read = {
    "openmetrics": openmetrics.parser.text_string_to_metric_families,
    "prometheus": prometheus.text_string_to_metric_families,
}[form]
with open(path, encoding="utf-8", newline="") as page:
    families = list(read(page.read()))

seen = set()
for family in families:
    if family.name in seen:
        sys.exit(f"{family.name} begins twice")
    seen.add(family.name)
    for sample in family.samples:
        key = (sample.name, *sorted(sample.labels.items()))
        if key in seen:
            sys.exit(f"{key} is there twice")
        seen.add(key)
        print(json.dumps({"family": family.name, "type": family.type, "unit": family.unit,
                          "help": family.documentation, "sample": sample.name,
                          "labels": sample.labels, "value": sample.value}))
