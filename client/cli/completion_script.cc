#include "client/cli/completion_script.h"

#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

std::string WordsOf(const CompletionCommand& command) {
  std::string words;
  for (const auto* list : {&command.commands, &command.options}) {
    for (const CompletionWord& word : *list) {
      words += (words.empty() ? "" : " ") + word.word;
    }
  }
  return words;
}

// In single quotes for any shell used here.
std::string Quote(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

}  // namespace

std::string BashCompletion(std::string_view program,
                           const std::vector<CompletionCommand>& commands) {
  const std::string name(program);
  std::string next;
  std::string cases;
  for (const CompletionCommand& command : commands) {
    if (!command.path.empty()) {
      const size_t space = command.path.find(' ');
      const std::string pattern = space == std::string::npos
                                      ? "/" + command.path
                                      : command.path.substr(0, space) + "/" +
                                            command.path.substr(space + 1);
      next +=
          absl::StrFormat("      %s) command='%s' ;;\n", pattern, command.path);
    }
    cases += absl::StrFormat("    '%s') words=%s ;;\n", command.path,
                             Quote(WordsOf(command)));
  }
  return absl::StrFormat(
      "# bash completion of %s\n"
      "_%s() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} command= words= word\n"
      "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
      "    case \"$command/$word\" in\n%s    esac\n"
      "  done\n"
      "  case \"$command\" in\n%s  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}\n"
      "complete -o default -F _%s %s\n",
      name, name, next, cases, name, name);
}

std::string ZshCompletion(std::string_view program,
                          const std::vector<CompletionCommand>& commands) {
  return "autoload -U +X compinit && compinit\n"
         "autoload -U +X bashcompinit && bashcompinit\n" +
         BashCompletion(program, commands);
}

std::string FishCompletion(std::string_view program,
                           const std::vector<CompletionCommand>& commands) {
  const std::string name(program);
  std::string script = "# fish completion of " + name + "\n";
  for (const CompletionCommand& command : commands) {
    std::string condition = "__fish_use_subcommand";
    if (!command.path.empty()) {
      condition.clear();
      size_t begin = 0;
      while (begin <= command.path.size()) {
        const size_t end =
            std::min(command.path.find(' ', begin), command.path.size());
        condition += (condition.empty() ? "" : "; and ") +
                     ("__fish_seen_subcommand_from " +
                      command.path.substr(begin, end - begin));
        begin = end + 1;
      }
    }
    for (const CompletionWord& word : command.commands) {
      script += absl::StrFormat("complete -c %s -n '%s' -f -a %s -d %s\n", name,
                                condition, word.word, Quote(word.description));
    }
    for (const CompletionWord& word : command.options) {
      script +=
          absl::StrFormat("complete -c %s%s -l %s -d %s\n", name,
                          command.path.empty() ? "" : " -n '" + condition + "'",
                          word.word.substr(2), Quote(word.description));
    }
  }
  return script;
}

}  // namespace argmesh
