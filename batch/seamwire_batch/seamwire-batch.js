// SPDX-License-Identifier: GPL-3.0-or-later
// A job type of Flamenco, Blender's render farm: copy this file into the folder `scripts` beside flamenco-manager.
// A folder of assets is worked on in shards, one task each; what comes last makes the tables and the contact sheet. All workers see the
// folders by the same names, and have seamwire-batch and a Blender with the add-on. https://flamenco.blender.org/usage/job-types/

const JOB_TYPE = {
    label: "Seamwire Batch",
    description: "Seams, islands and UV maps for a folder of assets",
    settings: [
        { key: "assets", type: "string", subtype: "dir_path", required: true, description: "Folder of .blend, .obj, .fbx, .glb, .ply and .stl files" },
        { key: "recursive", type: "bool", default: false, description: "Folders in folders too" },
        { key: "out", type: "string", subtype: "dir_path", required: true, description: "Folder of results" },
        { key: "way", type: "string", required: true, default: "source", choices: ["source", "network", "suggest"], description: "Where seams come from" },
        { key: "from", type: "string", subtype: "file_path", default: "", description: "The asset that has the seams, or the network" },
        { key: "options", type: "string", default: "", description: "More arguments of seamwire-batch, one a line" },
        { key: "shards", type: "int32", default: 16, description: "How many tasks the assets are divided into" },
        { key: "limit", type: "int32", default: 600, description: "Most seconds for an asset" },
        { key: "blender", type: "string", default: "{blender}", visible: "hidden", description: "What starts Blender" },
        { key: "command", type: "string", default: "seamwire-batch", visible: "hidden", description: "What starts seamwire-batch" },
    ],
};

function commandLine(settings) {
    let args = [settings.assets, "--out", settings.out, "--limit", String(settings.limit), "--blender", settings.blender];
    if (settings.recursive) {
        args.push("--recursive");
    }
    if (settings.way === "suggest") {
        args = args.concat(["--suggest", "-"]);
    } else if (settings.from) {
        args = args.concat([`--${settings.way}`, settings.from]);
    } else {
        throw new Error(`Seams from a ${settings.way}: name the file`);
    }
    return args.concat(settings.options.split("\n").map((line) => line.trim()).filter((line) => line !== ""));
}

function compileJob(job) {
    const settings = job.settings;
    if (settings.shards < 1) {
        throw new Error("There has to be one shard at least");
    }
    const args = commandLine(settings);
    const shards = [];
    for (let number = 1; number <= settings.shards; number++) {
        const task = author.Task(`shard-${number}`, "blender");
        const shard = ["--shard", `${number}/${settings.shards}`];
        task.addCommand(author.Command("exec", { exe: settings.command, args: args.concat(shard) }));
        shards.push(task);
        job.addTask(task);
    }
    const tables = author.Task("tables", "blender");
    tables.addCommand(author.Command("exec", { exe: settings.command, args: args }));
    for (const task of shards) {
        tables.addDependency(task);
    }
    job.addTask(tables);
}
