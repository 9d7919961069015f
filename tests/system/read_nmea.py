# Reads the sentences of a file with pynmea2 and writes what it made of each, one JSON object a line.
# Sentences it does not know, and AIS, are passed over; anything else wrong ends the program.
import json
import sys

import pynmea2

with open(sys.argv[1], encoding="ascii") as sentences:
    for line in sentences:
        if line.startswith("!"):
            continue
        try:
            message = pynmea2.parse(line.strip(), check=True)
        except pynmea2.SentenceTypeError:
            continue
        fields = {field[1]: value for field, value in zip(message.fields, message.data)}
        print(json.dumps({"sentence": message.sentence_type, "talker": message.talker, **fields}))
